#pragma once

#include <talus/overlap/grouping.hpp>

namespace talus::overlap {

/// What the distributed law reads of an interface.
struct InterfaceParameters {
  double normal_stiffness = 0;      ///< α_N, Pa/m
  double tangential_stiffness = 0;  ///< α_T, Pa/m
  double friction = 0;              ///< μ = tan φ
  double normal_damping = 0;        ///< share of critical
  double tangential_damping = 0;

  void add(double weight, const InterfaceParameters& other) {
    normal_stiffness += weight * other.normal_stiffness;
    tangential_stiffness += weight * other.tangential_stiffness;
    friction += weight * other.friction;
    normal_damping += weight * other.normal_damping;
    tangential_damping += weight * other.tangential_damping;
  }
};

/// A part of the overlap nearest to one side of the master: the load it puts there and where.
struct Cell {
  const Overlap* overlap;
  std::uint32_t master;  ///< 0: body a, 1: body b
  std::uint32_t side;
  Point normal;  ///< outward of the master
  Point foot;    ///< on the side, below the centroid
  double load;   ///< N/m, normal, of the springs
  InterfaceParameters interface;
  std::uint32_t segment_start, segment_end;
  double pressed = 0;  ///< N/m, what springs and dashpots bear along the normal of the contact
};

/// A sub-segment of the slave within a cell (Fig. 5), with its trapezoid load as two end loads.
struct Segment {
  std::uint32_t side;
  Point at[2];
  double depth[2];
  double length;
  double facing;   ///< cosine to the side of the master, 0 where it does not face that
  double load[2];  ///< N/m, at the two ends, normal to the slave
  double share() const { return length * (depth[0] + depth[1]) / 2; }
  double facing_share() const { return facing * share(); }
};

/// Resultant of some loads, to see what is left over.
struct Balance {
  Point force{0, 0};
  double moment = 0;  ///< about the first point
  Point origin{0, 0};
  bool started = false;

  void add(Point at, Point load) {
    if (!started) origin = at, started = true;
    force = force + load;
    moment += cross(at - origin, load);
  }
  double moment_about(Point point) const { return moment - cross(point - origin, force); }
};

}  // namespace talus::overlap
