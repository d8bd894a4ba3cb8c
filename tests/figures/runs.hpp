#pragma once

#include "scene/read.hpp"
#include "simulation/simulation.hpp"

#include <functional>
#include <string>
#include <vector>

namespace talus::figures {

/// What the program's own plugins bring.
Registry& registry();

/// A scene that ships, by its name, or one from text; with overrides.
Scene shipped(const std::string& name, const std::vector<Override>& overrides = {});
Scene from_text(const std::string& text, const std::vector<Override>& overrides = {});

/// The motion of a body at every output time.
struct Course {
  std::vector<double> time;
  std::vector<Motion> motion;

  double speed(double at) const;                       ///< m/s, linear between output times
  double moved_between(double from, double to) const;  ///< m, largest distance from the place at `from`
  Vec2 displacement(double at) const;                  ///< m, at the output time next to `at`
};

std::uint32_t body_number(const Scene& scene, const std::string& name);

/// Runs a scene to its end, settling first where it says so. `watch` is called at every output time.
Course run(const Scene& scene, const std::string& body, const RunSettings& settings = {},
           const std::function<void(const Simulation&)>& watch = {});

/// Runs to the end and says what stopped it, or "".
std::string trouble(const Scene& scene);

std::string hash_after(const Scene& scene, const RunSettings& settings);

}  // namespace talus::figures
