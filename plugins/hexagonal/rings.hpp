#pragma once

#include "connectivity.hpp"

#include <talus/cover_builder.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace talus::hexagonal {

/// The regions of all elements, one after the other.
struct Regions {
  std::vector<double> x, y;
  std::vector<std::uint32_t> vertex_start{0};  ///< [element + 1] into x, y
  std::vector<std::uint32_t> ring_start;     ///< as in talus::Region, counted from the element's first vertex
  std::vector<std::uint32_t> ring_begin{0};  ///< [element + 1] into ring_start

  Region of(std::size_t element) const {
    const std::uint32_t vertex = vertex_start[element], ring = ring_begin[element];
    return {x.data() + vertex, y.data() + vertex, ring_start.data() + ring,
            ring_begin[element + 1] - ring - 1};
  }
};

struct BoundaryVertex {
  Point at;
  std::uint32_t element;
  std::uint32_t side;  ///< as CoverSink numbers it
};

struct Boundary {
  std::vector<BoundaryVertex> vertices;
  std::vector<std::uint32_t> loop_start{0};  ///< [loop + 1]
};

/// Area and its first moments about `origin`.
struct RegionMoments {
  double area, x, y;
};
RegionMoments moments_about(Point origin, const Region& region);

Regions regions(const Faces& faces, const Connectivity& connectivity);

/// Loops with the body on their left. Where several touch in a point, each goes around its own material.
Boundary boundary(const Faces& faces, const Connectivity& connectivity);

}  // namespace talus::hexagonal
