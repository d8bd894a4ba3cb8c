#pragma once

#include "geometry/vec2.hpp"

#include <cstdint>
#include <vector>

namespace talus {

/// Where points come along Hilbert's curve through their bounding square, in steps of 2⁻¹⁶ of its side: close
/// along the curve is close in the plane.
std::vector<std::uint64_t> along_curve(const std::vector<Vec2>& points);

}  // namespace talus
