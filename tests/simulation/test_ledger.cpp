#include "simulation/simulation.hpp"
#include "working_scene.hpp"

#include <catch2/catch.hpp>

using namespace talus;

namespace {

/// A body in space, at rest until a force sets in at 0.01 s, damped as a whole.
WorkingScene pushed(const std::string& cover) {
  WorkingScene text;
  text.bodies = box("a", 0, 0, 2, 1, R"("cover": )" + cover);
  text.rest = R"("damping": 200, "loads": [{"body": "a", "point": [2, 1],
                 "force": [{"scale": 3000, "time": [[0.01, 0], [0.010001, 1], [0.02, 1]]},
                           {"scale": -2000, "time": [[0.01, 0], [0.013, 1]]}]}],)";
  text.time = R"({"end": 0.03, "dt": 1e-4})";
  text.output = R"({"history": 1e-4})";
  return text;
}

}  // namespace

TEST_CASE("the balance holds from the first step of a motion that starts under damping",
          "[simulation][ledger]") {
  for (const char* cover :
       {R"({"model": "rigid"})", R"({"model": "block"})", R"({"model": "hexagonal", "size": 0.5})"}) {
    INFO(cover);
    WorkingScene text = pushed(cover);
    Simulation simulation(text.read(), {});
    bool moved = false;
    while (simulation.advance()) {
      const EnergyLedger& ledger = simulation.ledger();
      moved = moved || ledger.kinetic > 0;
      CHECK(std::abs(ledger.residual) <= 1e-7 * ledger.throughput);
    }
    CHECK(moved);
    CHECK(simulation.ledger().global_damping_loss > 0);
  }
}
