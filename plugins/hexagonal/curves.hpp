#pragma once

#include "noding.hpp"

#include <talus/cover_builder.hpp>

#include <cstdint>
#include <utility>
#include <vector>

namespace talus::hexagonal {

/// Sides of outline and discontinuities as they were drawn, with their nodes.
struct Curves {
  std::vector<Segment> segments;
  struct Side {
    Point start, end;
  };
  std::vector<Side> outline, discontinuities;           ///< [label], [label − vertex_count]
  std::vector<std::uint32_t> outline_nodes;             ///< [vertex]
  std::vector<std::pair<std::uint32_t, Point>> points;  ///< of discontinuities, in the body's surroundings
};

inline std::uint32_t vertex_count(const Region& outline) {
  return outline.ring_start[outline.ring_count];
}

double distance(Point p, Point q);

/// Throws Refusal where more triangles would be needed than there is room for, or where vertices of the
/// outline would fall together.
Curves make_curves(const BodyShape& body, const Lattice& lattice, Nodes& nodes);

}  // namespace talus::hexagonal
