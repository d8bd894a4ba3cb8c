#pragma once

#include "lattice.hpp"
#include "noding.hpp"

#include <talus/cover_builder.hpp>

#include <cstdint>
#include <vector>

namespace talus::hexagonal {

/// An edge of the planar graph of outline, discontinuities and lattice, from node p to node q > p.
struct Edge {
  std::uint32_t p, q;
  EdgeKind kind;
  std::uint32_t label;   ///< of outline or discontinuity
  LatticeSide lattice;   ///< the side of the lattice that it lies on, if any
  bool against_lattice;  ///< p → q runs against that side's direction
  std::int32_t winding;  ///< how many more times the outline winds around its left than around its right
};

struct Arrangement {
  std::int64_t tolerance;       ///< grid steps
  std::vector<GridPoint> grid;  ///< [node] decides what is connected with what
  std::vector<Point> point;     ///< [node] m, exactly on the outline or the discontinuity it belongs to
  std::vector<Edge> edges;
};

/// Throws Refusal for what cannot be covered, TooClose for what another tolerance may cover.
Arrangement arrange(const BodyShape& body, const Lattice& lattice, std::int64_t tolerance);

/// Whether the exact points of all curves follow each other as on the grid.
bool is_in_order(const Arrangement& made, const Lattice& lattice);

}  // namespace talus::hexagonal
