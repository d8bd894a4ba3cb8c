#pragma once

#include "plugin/registry.hpp"
#include "scene/scene.hpp"
#include "simulation/simulation.hpp"

#include <string>

namespace talus {

/// The components of this build, loaded once.
Registry& shipped_registry();

/// A body of a scene: a rectangle, and what else its object holds (`"fixed": true`).
std::string box(const std::string& name, double left, double bottom, double right, double top,
                const std::string& more = "");

/// A scene that runs, in parts that a test may replace. Everything is JSON text.
struct WorkingScene {
  std::string bodies;
  std::string gravity = "[0, 0]";
  std::string cover = "rigid";
  std::string law = "overlap_area";
  std::string material =
      R"("density": 2300, "model": "linear_elastic", "young_modulus": 1e10, "poisson_ratio": 0.25)";
  std::string interface =
      R"("normal_stiffness": 1e10, "tangential_stiffness": 1e10, "friction_angle": 30,
         "normal_damping": 0, "tangential_damping": 0)";
  std::string monitors;
  std::string time = R"({"end": 1})";
  std::string output = "{}";
  std::string rest;  ///< further members of the scene, each with a comma behind

  Scene read(Registry& registry = shipped_registry()) const;
};

/// A block on a fixed base, under its weight.
WorkingScene resting_block();

Simulation run_to_end(const WorkingScene& text);
/// The same of a scene that settles first.
Simulation settle_and_run(const WorkingScene& text);

/// What the energy balance misses, as a share of the energy that went through it.
double residual_share(const EnergyLedger& ledger);

}  // namespace talus
