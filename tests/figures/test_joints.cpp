#include "figures/runs.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

using namespace talus;
using namespace talus::figures;

namespace {

/// Two blocks, one upon the other on a base, bonded, and knocked off.
Scene knocked_off(const std::string& cover, double softening) {
  WorkingScene text;
  text.law = "cohesive_overlap";
  text.gravity = "[0, -10]";
  text.material =
      R"("density": 2300, "model": "linear_elastic", "young_modulus": 1e10, "poisson_ratio": 0.25)";
  text.interface = fmt::format(
      R"("normal_stiffness": 1e10, "tangential_stiffness": 1e10, "friction_angle": 30,
         "normal_damping": 0, "tangential_damping": 0, "cohesion": 2e5, "tensile_strength": 1e5,
         "softening_opening": {}, "softening_slip": {})",
      softening, 5 * softening);
  text.bodies = box("base", -2, -1, 2, 0, R"("fixed": true)") + ", " +
                box("a", -0.5, 0, 0.5, 1, R"("velocity": [0.3, 0.2], "cover": )" + cover) + ", " +
                box("b", -0.5, 1, 0.5, 2, R"("cover": )" + cover);
  text.time = R"({"end": 0.3, "safety": 0.05})";
  text.output = R"({"history": 0.001})";
  return text.read();
}

}  // namespace

TEST_CASE("Joints that break: what bonds take is booked, and the ledger closes",
          "[figures][cohesive_overlap]") {
  for (const char* cover : {R"({"model": "block"})", R"({"model": "hexagonal", "size": 0.5})"}) {
    for (const double softening : {0.0, 2e-4}) {
      INFO(cover << ", softening " << softening);
      const Scene scene = knocked_off(cover, softening);
      Simulation simulation(scene, {});
      while (simulation.advance()) {
      }
      INFO(fmt::format("residual {:.2e}, lost {:.4g} J/m", simulation.summary().largest_residual_share,
                       simulation.ledger().friction_loss));
      CHECK(simulation.summary().largest_residual_share < 1e-3);
      CHECK(simulation.ledger().friction_loss > 50);
    }
  }
}

TEST_CASE("Joints that hold: bonded blocks hang, as far down as their springs let them",
          "[figures][cohesive_overlap]") {
  // 1 m³ of 2300 kg under a ceiling: 23 kN/m² of tension, 2.3 μm of opening, and as much again undamped.
  WorkingScene text;
  text.law = "cohesive_overlap";
  text.gravity = "[0, -10]";
  text.material =
      R"("density": 2300, "model": "linear_elastic", "young_modulus": 1e12, "poisson_ratio": 0.25)";
  text.interface = R"("normal_stiffness": 1e10, "tangential_stiffness": 1e10, "friction_angle": 30,
         "normal_damping": 0.5, "tangential_damping": 0.5, "cohesion": 2e5, "tensile_strength": 1e5)";
  text.bodies = box("ceiling", -2, 1, 2, 2, R"("fixed": true)") + ", " +
                box("a", -0.5, 0, 0.5, 1, R"("cover": {"model": "rigid"})");
  text.time = R"({"end": 0.05, "dt": "auto"})";
  text.output = R"({"history": 0.001})";
  const Course course = run(text.read(), "a");
  CHECK(course.displacement(0.05).y == Approx(-2.3e-6).epsilon(1e-3));
}
