#include "geometry/vanishing_depth.hpp"

#include <algorithm>
#include <limits>

namespace talus {

/// A side of length l between corners of angles θ and θ' vanishes at l/(cot θ/2 + cot θ'/2); with tangents u
/// and v before and after a corner cot θ/2 = u × v/(1 + u · v).
double vanishing_depth(const BoundaryCorner* ring, std::size_t count) {
  const auto half_cotangent = [&](std::size_t before, std::size_t after) {
    const BoundaryCorner &u = ring[before], &v = ring[after];
    return (u.tangent_x * v.tangent_y - u.tangent_y * v.tangent_x) /
           (1 + u.tangent_x * v.tangent_x + u.tangent_y * v.tangent_y);
  };
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t side = 0; side < count; ++side) {
    const std::size_t before = side == 0 ? count - 1 : side - 1, after = side + 1 == count ? 0 : side + 1;
    const double closing = half_cotangent(before, side) + half_cotangent(side, after);
    if (closing > 0) least = std::min(least, ring[side].length / closing);
  }
  return least;
}

}  // namespace talus
