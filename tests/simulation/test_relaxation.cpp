#include "simulation/simulation.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <cmath>

using namespace talus;

namespace {

/// A body of one cover on a fixed table, under its weight.
WorkingScene resting(const std::string& cover, const std::string& damping) {
  WorkingScene text;
  text.gravity = "[0, -10]";
  text.bodies =
      box("table", -3, -1, 3, 0, R"("fixed": true)") + ", " + box("a", -1, 0, 1, 1, R"("cover": )" + cover);
  text.rest = fmt::format(R"("settle": {{"duration": 5, "damping": "{}", "until": 1e-6}},)", damping);
  text.time = R"({"end": 0.01})";
  return text;
}

}  // namespace

TEST_CASE("relaxation finds the weight on the table and ends when forces balance",
          "[simulation][relaxation]") {
  for (const char* cover :
       {R"({"model": "rigid"})", R"({"model": "block"})", R"({"model": "hexagonal", "size": 0.5})"}) {
    for (const char* damping : {"adaptive", "kinetic"}) {
      INFO(cover << ' ' << damping);
      const Scene scene = resting(cover, damping).read();
      Simulation simulation(scene, {});
      simulation.settle();
      simulation.advance();
      double carried = 0;
      for (const Contact& contact : simulation.contacts()) carried += contact.normal_force.y;
      CHECK(carried == Approx(2300 * 2 * 10).epsilon(1e-4));
      const double nominal = 5 / simulation.critical_dt();
      CHECK(static_cast<double>(simulation.summary().settle_steps) < nominal);  // it ended early
      while (simulation.advance()) {
      }
      CHECK(simulation.body_motion(1).displacement.y == Approx(0).margin(1e-9));
    }
  }
}
