#pragma once

#include "geometry/vec2.hpp"

#include <talus/cover_builder.hpp>

#include <span>
#include <vector>

namespace talus {

using Ring = std::vector<Vec2>;  ///< closed, without repeating the first vertex; edge i runs from vertex i

/// Signed area and the integrals of x, y, xx, xy, yy over a ring, about `centre`; negative for a clockwise
/// ring.
AreaMoments ring_moments(std::span<const Vec2> ring, Vec2 centre);

AreaMoments operator+(const AreaMoments& p, const AreaMoments& q);

/// Integrals of a region about its own centroid: ∫dA, m², ∫xx, ∫xy, ∫yy, m⁴.
struct CentralMoments {
  double area, xx, xy, yy;
};
CentralMoments about_centroid(const AreaMoments& moments);

/// Smallest distance between two parallel lines that enclose the ring's convex hull: the smallest width, m.
double smallest_width(std::span<const Vec2> ring);

}  // namespace talus
