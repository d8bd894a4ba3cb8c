#pragma once

#include "geometry/box.hpp"
#include "geometry/geos.hpp"

#include <cstdint>
#include <vector>

namespace talus {

/// A polyline that cuts, with the surface that the faces along it belong to (0 for none).
struct Cut {
  std::vector<Vec2> points;
  std::uint32_t surface = 0;
  bool drawn = false;  ///< as it is by the user, line by line
};

/// Parallel joints: number k lies at offset + (k + jitter * (-1 to 1)) * spacing from the line through the
/// scene's (0, 0), so that neighbouring domains continue each other.
struct JointSet {
  double dip;          ///< rad, from the x axis, counter-clockwise
  double spacing;      ///< m
  double offset;       ///< m, to the left of the direction of the joints
  double jitter;       ///< share of the spacing
  double persistence;  ///< share of each line that is open, above 0 to 1
  double gap;          ///< m, bridge of rock between the parts of a line; of no meaning at persistence 1
  std::uint64_t seed;
  std::uint32_t surface;
};

/// Courses of bricks from the lower left corner of the box up.
struct Bricks {
  double width, height;  ///< m, of a brick
  double gap;            ///< m, between bricks
  bool running;          ///< whether every second course is shifted by half

  /// Whether the point lies in the gap between bricks.
  bool in_gap(const Box& box, Vec2 point) const;
};

/// Points whose Voronoi cells are the blocks.
struct Sites {
  double count;    ///< at random in the box where there is no spacing
  double spacing;  ///< m, of a hexagonal grid; 0 for none
  double jitter;   ///< share of the spacing by which its points are moved at random
  std::uint64_t seed;
};

// Lines over the box and somewhat beyond, in an order that depends on the arguments alone.
void add_joints(const JointSet& set, const Box& box, std::vector<Cut>& cuts);
void add_bricks(const Bricks& bricks, const Box& box, std::vector<Cut>& cuts);
/// `domain`: outer boundary and openings.
void add_voronoi(const Sites& sites, const std::vector<Ring>& domain, const Geos& geos,
                 std::vector<Cut>& cuts);

/// How many joints of a set there are over a box, about.
double lines_of(const JointSet& set, const Box& box);

/// How dense lines are in a domain, to say before they are made how many blocks there will be.
struct Density {
  double pieces;  ///< lines, or cells
  double length;  ///< 1/m, of lines per area
};
Density density_of(const JointSet& set, const Box& box);
Density density_of(const Bricks& bricks, const Box& box);
Density density_of(const Sites& sites, const Box& box);
Density density_of(const std::vector<Cut>& cuts, const Box& box);

/// An upper estimate: all pieces, and a block per crossing of lines from different sources.
double estimated_blocks(const std::vector<Density>& sources, const Box& box);

}  // namespace talus
