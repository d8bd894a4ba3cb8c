#pragma once

#include "geometry/polygon.hpp"

#include <optional>
#include <string>
#include <vector>

namespace talus {

/// Loop 0 is the outer boundary, the others are holes; m.
using Loops = std::vector<Ring>;

struct ShapeFault {
  std::size_t loop;
  std::optional<std::size_t> vertex;  ///< where one vertex is at fault
  std::string message;
};

double signed_area(const Ring& ring);  ///< m², positive if counter-clockwise

/// What keeps the loops from bounding a body: zero-length edges, no area, crossing edges, holes outside.
std::vector<ShapeFault> shape_faults(const Loops& loops);

/// Whether the point is within the body or at most `margin` outside it.
bool contains(const Loops& loops, Vec2 point, double margin);

/// The longer side of the box around the body, m.
double extent(const Loops& loops);

struct BodyOverlap {
  std::size_t a, b;  ///< a < b
  double area;       ///< m²
};

/// Pairs of bodies that overlap by more than rounding: 1e-6 of the smaller one's width.
std::vector<BodyOverlap> overlapping_bodies(const std::vector<const Loops*>& bodies);

}  // namespace talus
