#pragma once

#include "geometry/polygon.hpp"

#include <array>
#include <vector>

namespace talus {

/// Least x and y, greatest x and y of the rings of a region, m.
std::array<double, 4> box_of(const std::vector<Ring>& region);

/// Squared distances of a point, m²; 0 within.
double squared_distance(const std::array<double, 4>& box, Vec2 p);
double squared_distance(const std::vector<Ring>& region, Vec2 p);

}  // namespace talus
