#pragma once

#include "simulation/simulation.hpp"

#include <cstddef>

namespace talus::benchmarks {

/// What a step of a scene has to look at, as the bodies lie now.
struct PairCounts {
  std::size_t overlapping = 0;  ///< pairs of bodies that the contact law found in contact
  /// Pairs of bodies, at least one of which moves, whose boxes meet when each grows by a twentieth of the
  /// mean size of a block to all sides: what a neighbour list of boxes would hold, whatever the program
  /// keeps.
  std::size_t candidates = 0;
};

PairCounts count_pairs(const Simulation& simulation);

/// Mean speed of the moving bodies, m/s.
double mean_speed(const Simulation& simulation);

/// Memory of this process, bytes; 0 where the system does not tell.
std::size_t resident_memory();
/// The largest since forget_peak().
std::size_t peak_memory();
/// Gives freed memory back and begins to watch for the peak anew.
void forget_peak();

}  // namespace talus::benchmarks
