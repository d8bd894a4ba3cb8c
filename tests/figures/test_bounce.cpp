#include "figures/runs.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <cmath>

using namespace talus;
using namespace talus::figures;

namespace {

/// A block thrown at a fixed base without gravity, its lowest point `gap` above it, m.
Scene thrown(const std::vector<Vec2>& ring, double degrees, const std::string& cover, double safety,
             double gap = 1e-3) {
  const double angle = degrees * 3.14159265358979323846 / 180;
  std::vector<Vec2> turned;
  double low = 1e300;
  for (const Vec2 p : ring) {
    turned.push_back(
        {p.x * std::cos(angle) - p.y * std::sin(angle), p.x * std::sin(angle) + p.y * std::cos(angle)});
    low = std::fmin(low, turned.back().y);
  }
  std::string polygon;
  for (const Vec2 p : turned) {
    polygon += fmt::format("{}[{:.17g}, {:.17g}]", polygon.empty() ? "" : ", ", p.x, p.y - low + gap);
  }
  return from_text(fmt::format(R"({{
    "talus": 1,
    "materials": {{"rock": {{"density": 2300, "model": "linear_elastic", "young_modulus": 1e10, "poisson_ratio": 0.25}}}},
    "cover": {{"model": "{}"}},
    "contact": {{"model": "frictionless"}},
    "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e10, "normal_damping": 0}}],
    "bodies": [
      {{"name": "base", "polygon": [[-4, -2], [4, -2], [4, 0], [-4, 0]], "material": "rock", "fixed": true}},
      {{"name": "block", "polygon": [{}], "material": "rock", "velocity": [0, -1]}}
    ],
    "limits": {{"energy_residual": 1}},
    "time": {{"end": 0.02, "safety": {}}},
    "output": {{"history": 0.02}}
  }})",
                               cover, polygon, safety));
}

struct Bounce {
  double error;    ///< of the total energy after, as a share of that before
  double overlap;  ///< m
};

Bounce bounce(const Scene& scene) {
  Simulation simulation(scene, {});
  simulation.advance();
  const double before = simulation.ledger().kinetic;
  while (simulation.advance()) {
  }
  REQUIRE(simulation.contacts().empty());
  REQUIRE(simulation.summary().largest_penetration > 1e-5);
  const EnergyLedger& after = simulation.ledger();
  return {std::abs(after.kinetic + after.strain + after.contact - before) / before,
          simulation.summary().largest_penetration};
}

const std::vector<Vec2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

std::vector<Vec2> chamfered(double size) {
  return {{size, 0}, {1 - size, 0}, {1, size}, {1, 1}, {0, 1}, {0, size}};
}

struct Case {
  std::string name;
  std::vector<Vec2> ring;
  double degrees;
};

const std::vector<Case> cases{{"flat", square, 0},
                              {"corner at 30 degrees", square, 30},
                              {"chamfer of 10 mm, flat", chamfered(0.01), 0},
                              {"chamfer of 10 mm at 30 degrees", chamfered(0.01), 30},
                              {"chamfer of 10 mm on the chamfer", chamfered(0.01), 45},
                              {"chamfer of 2 mm, flat", chamfered(0.002), 0},
                              {"chamfer of 2 mm at 30 degrees", chamfered(0.002), 30},
                              {"chamfer of 2 mm on the chamfer", chamfered(0.002), 45}};

}  // namespace

TEST_CASE("A frictionless bounce gives all energy back", "[slow][figures]") {
  // A corner meets the base softly, its force grows with the square of its depth, and 0.002 of the critical
  // step is enough. A side meets it with a kink in the force, whose place between two steps errs by (omega
  // dt)²/8.
  for (const std::string cover : {"rigid", "block"}) {
    for (const Case& one : cases) {
      const double safety = one.degrees == 0 ? 2e-4 : 2e-3;
      const Bounce b = bounce(thrown(one.ring, one.degrees, cover, safety));
      INFO(fmt::format("{}, {}: {:.2e} at {}, {:.3g} m deep", cover, one.name, b.error, safety, b.overlap));
      CHECK(b.error < 1e-8);
    }
  }
}

TEST_CASE("A frictionless bounce errs with the square of the time step", "[slow][figures]") {
  for (const std::string cover : {"rigid", "block"}) {
    for (const Case& one : cases) {
      // From where in a step the contact begins and ends the error of one run scatters: worst of many. A gap
      // wider by a part of a step's way moves the beginning, a step a little smaller the end.
      const auto worst = [&](double safety) {
        double error = 0;
        for (int phase = 0; phase < 48; ++phase) {
          const double wider = 7e-4 * safety * (phase % 8) / 8, smaller = 1 - 0.023 * (phase / 8);
          const Scene scene = thrown(one.ring, one.degrees, cover, smaller * safety, 1e-3 + wider);
          error = std::max(error, bounce(scene).error);
        }
        return error;
      };
      const double coarse = worst(0.08), fine = worst(0.01);
      const double order = std::log2(coarse / fine) / 3;
      INFO(fmt::format("{}, {}: {:.2e} at 0.08, {:.2e} at 0.01: order {:.2f}", cover, one.name, coarse, fine,
                       order));
      CHECK(order > 1.8);
    }
  }
}
