#pragma once

#include "blocks/lines.hpp"

#include <cstdint>
#include <functional>
#include <set>
#include <utility>
#include <vector>

namespace talus {

/// Shape with the surface of each edge (0 for none); loop 0 outside and counter-clockwise, holes clockwise.
struct Block {
  Loops loops;
  std::vector<std::vector<std::uint32_t>> edge_surface;
  double area = 0;  ///< m²
  Vec2 centroid;
};

struct CutOrder {
  Block domain;
  std::vector<Cut> cuts;
  std::function<bool(Vec2)> is_void;  ///< whether what lies around a point within a block is left out
  double smallest_area = 0;           ///< m²
  double smallest_share = 0;          ///< of the mean area; the larger of the two counts
  double split_share = 0;  ///< of the convex quadrilaterals that are split into triangles, at random
  std::uint64_t split_seed = 0;
};

/// The straight edge that takes the place of a corner.
struct Chord {
  Vec2 corner, from, to;
};

/// Where a drawn line ends within a block-to-be.
struct LooseEnd {
  Vec2 at;
  double gap;  ///< m, to the nearest line or boundary
};

/// Surfaces of two lines that lie on each other: the one that names the sides there, and the other.
using NamesOfOneLine = std::set<std::pair<std::uint32_t, std::uint32_t>>;

struct CutDomain {
  std::vector<Block> blocks;
  double left_out = 0;     ///< m², below the smallest area and without a neighbour to join
  std::size_t pieces = 0;  ///< that lines cut the domain into, before small ones joined others
  std::vector<LooseEnd> loose_ends;
  NamesOfOneLine names_of_one_line;
  std::vector<Vec2> bridged;  ///< where corners were cut off between boundaries of one block, see pinches.hpp
};

/// The blocks into which lines cut the domain, and where drawn lines cut nothing. Ends of lines that lead
/// nowhere do not cut; ends that come within 1e-8 of the domain's size of another line count as meeting it. A
/// block below the smallest area, or thinner than 1e-7 of the domain's size, joins the neighbour with which
/// it has the longest boundary in common, the smallest first; one without neighbour is left out.
/// Quadrilaterals are split last, along the shorter diagonal, where no triangle is below the smallest area.
///
/// Sorted by centroid (x, then y), then area; each loop begins at its lowest vertex, of these the leftmost,
/// and has no vertex within a straight edge. Throws std::runtime_error where the geometry cannot be worked
/// with.
CutDomain cut_domain(const CutOrder& order, const Geos& geos);

}  // namespace talus
