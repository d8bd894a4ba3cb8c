#pragma once

#include "simulation/simulation.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace talus {

/// A part of a body that strains uniformly: where it stood, and how far its corners came.
struct MovedPart {
  struct Point {
    Vec2 from, moved;  ///< m, without the scene's origin
  };
  std::size_t body;
  std::vector<std::vector<Point>> loops;
};

/// How a scene fared with its strength divided by a factor.
struct ReducedRun {
  double factor = 1;
  bool collapsed = false;
  double displacement = 0;                 ///< m, the largest of a vertex
  std::size_t body = 0;                    ///< that body
  double kinetic = 0;                      ///< J/m at the end
  double lasted = 0;                       ///< s
  std::vector<std::size_t> moving;         ///< bodies that failed, where it collapsed
  bool stands_again = false;               ///< all of these have come to rest
  std::vector<std::size_t> moving_little;  ///< bodies that move on too slowly to tell
  std::vector<std::size_t> came_to_rest;   ///< bodies that stand, but only after a hundredth of their width
  std::string trouble;                     ///< what stopped it, if anything did
  std::vector<MovedPart> parts;            ///< of all bodies, where it collapsed of itself
};

struct SafetySettings {
  double tolerance = 0.01;  ///< share of the factor
  double lowest = 0.1, highest = 20;
  int threads = 1;
  std::function<void(const ReducedRun&)> tried{};  ///< called after each
  std::function<bool()> interrupted{};             ///< asked once per step
};

struct Safety {
  std::optional<double> stands, falls;  ///< the largest factor that stood, the least that fell
  std::vector<ReducedRun> runs;         ///< in the order in which they were made
  bool interrupted = false;
  bool of_what_is_left = false;       ///< some of the scene went while it settled with its full strength
  std::vector<std::string> warnings;  ///< of the run that settled with full strength
  std::string trouble;                ///< in words, where no run stands and the strongest was stopped

  std::optional<double> factor() const;  ///< of safety, between the two
};

/// Of runs with ever more strength, none of which stands: what stopped the last of them, in words, or nothing
/// where it collapsed of itself.
std::string trouble_of_runs(const std::vector<ReducedRun>& runs);

/// Strength reduction: the factor by which strength can be divided before a scene collapses, by bisection.
/// All runs start from the geometry that the scene settles into with its full strength (bonded ones from
/// where bodies are drawn, for bonds know no other start), settle once more with theirs, and last as long as
/// the scene says, or up to eight times as long where a body goes on that has not yet come far enough to
/// tell. What counts is how far the vertices of a body, or of what joints cut out of one, have come from that
/// geometry, along axes along which nothing drives it. It has failed if one moved by more than 1/20 of its
/// width, of one of many elements of their size where that is less, wherever it stopped, or goes on: in the
/// run itself by more than 1/1000 of its width, more than 0.45 of it in the second half of the time, or all
/// of that 1/1000 there at a constant speed, and at the end at more than 0.9 of the speed in the middle. The
/// scene collapses if one has.
Safety factor_of_safety(const Scene& scene, const SafetySettings& settings);

}  // namespace talus
