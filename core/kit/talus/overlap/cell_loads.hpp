#pragma once

#include <talus/overlap/grouping.hpp>

#include <cstdint>
#include <limits>
#include <span>

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
  double depth;  ///< m, of its deepest point
  InterfaceParameters interface;
  std::uint32_t segment_start, segment_end;
  double pressed = 0;         ///< N/m, what springs and dashpots bear along the normal of the contact
  Point pressed_at{};         ///< where they do
  double pressed_on_end = 0;  ///< N/m, of it, on the end of the side
  double shear = 0;           ///< the share of friction that acts here
  Point shear_at{};           ///< where it does
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

/// Resultant of some loads.
struct Balance {
  Point force{0, 0};
  double moment = 0;  ///< about the first point
  Point origin{0, 0};
  bool started = false;

  void add(Point at, Point load, double couple = 0) {
    if (!started) origin = at, started = true;
    force = force + load;
    moment += cross(at - origin, load) + couple;
  }
  double moment_about(Point point) const { return moment - cross(point - origin, force); }
};

/// The side of the slave that bounds most of the overlap, for a cell that no slave boundary enters; the
/// nearest where none bounds it, as when a strip lies within the slave. Not the first, which would go by
/// where a polygon starts or who is body a, and the other way round in a mirror image.
inline std::uint32_t bounding_side(const Overlap& overlap, const Piece& slave) {
  const std::uint32_t slave_body = &slave == &overlap.piece[0] ? 0 : 1;
  double longest = -1;
  std::uint32_t side = 0;
  for (std::size_t i = 0; i < overlap.polygon.size(); ++i) {
    const Corner& corner = overlap.polygon[i];
    if (corner.side.body != slave_body || !slave.real(corner.side.index)) continue;
    const double here = length(overlap.polygon[overlap.polygon.next(i)].at - corner.at);
    if (here > longest) longest = here, side = corner.side.index;
  }
  if (longest >= 0) return side;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < slave.size(); ++i) {
    if (!slave.real(i)) continue;
    const double here = slave.depth(i, overlap.region.centroid);
    if (here < nearest) nearest = here, side = i;
  }
  return side;
}

/// Parameters of a cell: of its master side with the slave sides in it, by their shares of the overlap along
/// the normal of the cell, so that nothing jumps when a slave corner passes a division line. Friction goes by
/// what each bears, α_N times its share: the cell slips at Σ μ_k N_k.
template <class Law>
InterfaceParameters interface_of(const Law& law, const Interfaces& interfaces, const Overlap& overlap,
                                 const Piece& master, const Piece& slave, std::uint32_t side,
                                 std::span<const Segment> segments) {
  const auto parameters_with = [&](std::uint32_t slave_side) {
    const std::uint32_t row =
        interfaces.row[master.surface(side) * interfaces.surface_count + slave.surface(slave_side)];
    return law.interface(interfaces.value + row * interfaces.parameter_count);
  };
  if (segments.size() == 1) return parameters_with(segments[0].side);
  double total = 0, borne = 0, slips = 0;
  for (const Segment& segment : segments) total += segment.facing_share();
  if (!(total > 0)) return parameters_with(bounding_side(overlap, slave));
  InterfaceParameters mean;
  const double stiffness = parameters_with(segments[0].side).normal_stiffness;
  bool alike = true;
  for (const Segment& segment : segments) {
    const InterfaceParameters own = parameters_with(segment.side);
    const double weight = segment.facing_share() / total;
    mean.add(weight, own);
    alike = alike && own.normal_stiffness == stiffness;
    borne += weight * own.normal_stiffness;
    slips += weight * own.normal_stiffness * own.friction;
  }
  if (!alike && borne > 0) mean.friction = slips / borne;
  return mean;
}

}  // namespace talus::overlap
