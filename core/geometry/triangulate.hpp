#pragma once

#include "geometry/vec2.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace talus {

/// Triangles that fill a polygon with holes, for drawing. Loop 0 is the outer one, counter-clockwise, the
/// others are holes, clockwise; corners are numbered through all loops.
std::vector<std::array<std::uint32_t, 3>> triangulate(const std::vector<std::vector<Vec2>>& loops);

}  // namespace talus
