#pragma once

#include "kernels/contact_totals.hpp"
#include "model/motion.hpp"

#include <talus/contact_model.hpp>

#include <cmath>

namespace talus::kernels {

// Loops over the pairs of bodies that a law was asked about, compiled for several instruction sets (see
// CMakeLists.txt beside). Sums are taken in an order that neither the instruction set changes nor which of
// the pairs that are apart a law was asked about.

/// By how much the bodies of a pair can have closed a gap since some time: as they drift towards each other
/// at most and any two corners have strayed from how they drift; or as any two have come towards each other
/// at all, if that is less.
struct Way {
  double time = 0;                    ///< s
  double strayed = 0, travelled = 0;  ///< m

  double of(double approach) const {
    const double drifted = approach * time + strayed;
    return drifted < travelled ? drifted : travelled;
  }
};

/// Bounds need half the digits, as long as they stay bounds: less by more than rounding adds.
inline float at_most(double value) {
  constexpr double digits = 0x1p-23;
  return static_cast<float>(value * (value > 0 ? 1 - digits : 1 + digits));
}
inline float at_least(double value) {
  return -at_most(-value);
}

/// The velocities with which the corners of a body are taken to go on (CornerDrift), by a circle around them.
struct Drift {
  float x = 0, y = 0;  ///< m/s, its middle
  float spread = 0;    ///< m/s, by which that of a corner differs at most

  /// By a circle around them and rest.
  Drift with_rest() const { return {0, 0, at_least(approach({}))}; }

  /// m/s, by which corners of two bodies differ at most.
  double approach(const Drift& other) const {
    const double dx = double{other.x} - x, dy = double{other.y} - y;
    return std::sqrt(dx * dx + dy * dy) + (double{spread} + other.spread);
  }
};

/// What the dashpots of a pair did in the last step. Single precision serves: these books owe more to the
/// step.
struct FormerDashpots {
  float power = 0;  ///< J/m, PairReport::damping_power
  float force = 0;  ///< N/m
};

/// What is kept of the pairs of a batch, and what a law found of them; [pair].
struct PairBooks {
  BodyPair* pairs;
  float* ask_again;          ///< m of way, see Way, when a law is to be asked next
  float* approach;           ///< m/s, at which its bodies drift together at most
  FormerDashpots* dashpots;  ///< at the first slot of a pair in contact
  double* history;           ///< [slot * history_doubles] of the last step
  const double* found;       ///< the same, of this one
  const PairReport* reports;
  std::uint32_t history_doubles;
  const Drift* drift;  ///< [body]
  Way way;             ///< up to now
  double rounding;     ///< m, by which a gap may be less than a law says
  bool skin;           ///< pairs apart need no look until their gap may be closed
};

/// What closing the pairs of a chunk leaves to be done.
struct ClosedChunk {
  struct Pairs {
    std::uint32_t count = 0, number[pair_chunk];

    void add(std::uint32_t pair) { number[count++] = pair; }
    const std::uint32_t* begin() const { return number; }
    const std::uint32_t* end() const { return number + count; }
  };
  Pairs met;            ///< those that have just come into contact
  Pairs parted;         ///< those that have just lost contact
  Pairs short_of_room;  ///< those with more contacts than slots: they were left as they were
  bool finite = true;   ///< what all reports add up to
};

struct ContactKernels {
  /// Of `count` pairs of a batch those that are due by now, rising, to `chosen`, which has room for all.
  /// Returns how many.
  std::uint32_t (*choose)(const float* ask_again, const float* approach, std::uint32_t count, const Way& now,
                          std::uint32_t* chosen);
  /// What the law found of pairs of one chunk becomes what it is told of the last step, and is added to
  /// `totals`.
  void (*close)(const PairBooks& books, const std::uint32_t* active, std::size_t count, ContactTotals& totals,
                ClosedChunk& closed);
};

}  // namespace talus::kernels
