#pragma once

#include <cstddef>
#include <cstdint>

namespace talus {

/// What all contacts of a step add up to, J/m and m.
struct ContactTotals {
  double stored = 0, slip_loss = 0, damping_loss = 0;
  double penetration = 0;
  std::uint32_t deepest_a = 0, deepest_b = 0;  ///< bodies of the deepest overlap
};

/// Pairs whose energies are added up before those of others, at most. All larger parts are made of such
/// chunks, so no sum shows how large they are.
inline constexpr std::size_t pair_chunk = 64;

}  // namespace talus
