#pragma once

#include "simulation/simulation.hpp"

#include <functional>
#include <string>
#include <vector>

namespace talus::verification {

/// The motion of a body at every output time.
struct Course {
  std::vector<double> time;
  std::vector<Motion> motion;

  double speed(double at) const;                       ///< m/s, linear between output times
  double moved_between(double from, double to) const;  ///< m, largest distance from the place at `from`
  Vec2 displacement(double at) const;                  ///< m, at the output time next to `at`
  std::size_t fastest() const;                         ///< number of the output time with the largest speed
};

double magnitude(Vec2 v);

/// Throws std::logic_error where there is no such body.
std::uint32_t body_number(const Scene& scene, const std::string& name);

using Watch = std::function<void(const Simulation&)>;

/// Runs a scene to its end, settling first where it says so. `watch` is called at every output time. Throws
/// NumericalTrouble.
Course run(const Scene& scene, const std::string& body, const RunSettings& settings = {},
           const Watch& watch = {});

/// The same without a body to follow.
RunSummary run_through(const Scene& scene, const RunSettings& settings = {}, const Watch& watch = {});

/// Runs to the end and says what stopped it, or "".
std::string trouble_of(const Scene& scene);

/// Of the state at the end.
std::string hash_after(const Scene& scene, const RunSettings& settings);

}  // namespace talus::verification
