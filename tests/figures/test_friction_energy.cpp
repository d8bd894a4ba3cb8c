#include "simulation/simulation.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <cmath>

using namespace talus;

namespace {

/// Three spinning bodies that meet at corners and sides.
Scene impact(const std::string& cover, double friction_angle, double safety) {
  WorkingScene text;
  text.material =
      R"("density": 2300, "model": "linear_elastic", "young_modulus": 1e9, "poisson_ratio": 0.25)";
  text.interface = fmt::format(R"("normal_stiffness": 1e9, "tangential_stiffness": 1e9, "friction_angle": {},
                                  "normal_damping": 0, "tangential_damping": 0)",
                               friction_angle);
  text.bodies = fmt::format(
      R"({{"name": "a", "material": "rock", "polygon": [[0, 0], [1, 0], [1, 1], [0, 1]], "velocity": [2, 0.3],
           "angular_velocity": 40, "cover": {0}}},
         {{"name": "b", "material": "rock", "polygon": [[1.3, 0.3], [2.1, -0.3], [2.9, 0.5], [2, 1.3]],
           "velocity": [-2, 0], "angular_velocity": -30, "cover": {0}}},
         {{"name": "c", "material": "rock", "polygon": [[1, 1.6], [2, 1.7], [1.5, 2.6]], "velocity": [0, -3],
           "cover": {{"model": "block"}}}})",
      cover);
  text.time = fmt::format(R"({{"end": 0.6, "safety": {}}})", safety);
  text.output = R"({"history": 0.01})";
  return text.read();
}

}  // namespace

TEST_CASE("Impact with friction: bodies that strain keep momentum, and the ledger closes",
          "[figures][friction]") {
  for (const char* cover : {R"({"model": "block"})", R"({"model": "hexagonal", "size": 0.3, "angle": 7})"}) {
    for (const double friction : {0.0, 20.0, 60.0}) {
      INFO(cover << ' ' << friction);
      const Scene scene = impact(cover, friction, 0.1);
      Simulation simulation(scene, {});
      double mass[3] = {2300, 0, 0};
      Vec2 before, after;
      const auto momentum = [&] {
        Vec2 sum;
        for (std::size_t i = 0; i < 3; ++i) {
          const Vec2 v = simulation.body_motion(i).velocity;
          sum = {sum.x + mass[i] * v.x, sum.y + mass[i] * v.y};
        }
        return sum;
      };
      for (std::size_t i = 0; i < 3; ++i) mass[i] = build_model(scene).bodies[i].mass;
      simulation.advance();
      before = momentum();
      while (simulation.advance()) {
      }
      after = momentum();
      const double scale = std::hypot(before.x, before.y);
      CHECK(std::hypot(after.x - before.x, after.y - before.y) <= 1e-12 * scale);
      CHECK(simulation.summary().largest_penetration > 0.01);
      CHECK(simulation.summary().largest_residual_share <= 1e-4);
      CHECK((friction == 0 || simulation.ledger().friction_loss > 100));
    }
  }
}
