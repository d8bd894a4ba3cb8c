#pragma once

#include "contact/contact_totals.hpp"
#include "contact/pair_parts.hpp"

#include <talus/contact_model.hpp>

namespace talus::kernels {

// Loops over the pairs of bodies that a law was asked about, compiled for several instruction sets (see
// CMakeLists.txt beside). Sums are taken in an order that neither the instruction set changes nor which of
// the pairs that are apart a law was asked about.

/// What is kept of the pairs of a batch, and what a law found of them; [pair].
struct PairBooks {
  BodyPair* pairs;
  double* ask_again;      ///< m of way, when a law is to be asked next
  double* damping_power;  ///< J/m of the last step
  double* history;        ///< [slot * history_doubles] of the last step
  const double* found;    ///< the same, of this one
  const PairReport* reports;
  std::uint32_t history_doubles;
  double travelled;  ///< m, the way up to now
  bool skin;         ///< pairs apart need no look until their gap may be closed
};

/// What closing the pairs of a chunk leaves to be done.
struct ClosedChunk {
  struct Pairs {
    std::uint32_t count = 0, number[pair_chunk];

    void add(std::uint32_t pair) { number[count++] = pair; }
    const std::uint32_t* begin() const { return number; }
    const std::uint32_t* end() const { return number + count; }
  };
  Pairs parted;         ///< those that have just lost contact
  Pairs short_of_room;  ///< those with more contacts than slots: they were left as they were
  bool finite = true;   ///< what all reports add up to
};

struct ContactKernels {
  /// Of `count` pairs of a batch those that are due by `until`, rising, to `chosen`, which has room for all.
  /// Returns how many.
  std::uint32_t (*choose)(const double* ask_again, std::uint32_t count, double until, std::uint32_t* chosen);
  /// What the law found of pairs of one chunk becomes what it is told of the last step, and is added to
  /// `totals`.
  void (*close)(const PairBooks& books, const std::uint32_t* active, std::size_t count, ContactTotals& totals,
                ClosedChunk& closed);
};

}  // namespace talus::kernels
