#pragma once

#include <cstdint>

namespace talus {

/// What all contacts of a step add up to, J/m and m.
struct ContactTotals {
  double stored = 0, slip_loss = 0, damping_loss = 0;
  double penetration = 0;
  std::uint32_t deepest_a = 0, deepest_b = 0;  ///< bodies of the deepest overlap
};

}  // namespace talus
