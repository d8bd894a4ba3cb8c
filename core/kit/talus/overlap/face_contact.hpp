#pragma once

#include <talus/contact_model.hpp>
#include <talus/overlap/cell_loads.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace talus::overlap {

/// What the springs of a cluster press with, as NormalLoads leaves it.
struct SpringLoads {
  std::span<const Overlap> overlaps;
  std::span<const Point> on_b;        ///< [overlap] N/m on body b
  std::span<const Segment> segments;  ///< of the slaves, which cells refer to
};

/// What acts on body b as it acts on the slave of a cell, and the other way round.
inline Point on_slave(const Cell& cell, Point on_b) {
  return cell.master == 0 ? on_b : -1.0 * on_b;
}
inline Point on_b(const Cell& cell, Point on_slave) {
  return cell.master == 0 ? on_slave : -1.0 * on_slave;
}

/// One contact at work: overlaps that hang together and face the other body one way. First find_tangent() and
/// measure_arcs(), then dashpots add to what presses, and friction acts along the tangent.
class FaceContact {
 public:
  SpringLoads springs;
  std::vector<Cell> cells;
  Point tangent{0, 0};
  Point normal_on_b{0, 0};  ///< N/m, of springs, then with what dashpots push
  Balance all_on_b;         ///< all that acts on body b
  double length = 0;        ///< m, L along the tangent; 0 where none can be told
  double slip_velocity = 0, slip_increment = 0;

  /// §3.2.2: n_c is the direction of the resultant, s_c is perpendicular to it. A cell presses along n_c with
  /// a part of its load only: what presses a corner from both its sides adds no friction to it.
  void find_tangent(std::span<const std::uint32_t> members) {
    normal_on_b = {0, 0};
    for (const std::uint32_t member : members) normal_on_b = normal_on_b + springs.on_b[member];
    const double size = overlap::length(normal_on_b);
    const Point normal = size > 0 ? (1 / size) * normal_on_b : cells[0].normal;
    tangent = {-normal.y, normal.x};
    all_on_b = {};
    for (Cell& cell : cells) {
      all_on_b.add(cell.foot, on_b(cell, cell.load * cell.normal));
      cell.pressed = std::max(0.0, dot(on_slave(cell, normal), cell.normal)) * cell.load;
      cell.pressed_at = cell.foot;
      cell.shear = cell.interface.friction * cell.pressed;
      cell.shear_at = cell.foot;
    }
  }

  /// On body b.
  Point normal() const { return {tangent.y, -tangent.x}; }

  /// The direction in which the springs of an overlap push the slave.
  Point normal_of_overlap(const Cell& cell) const {
    const Point spring = springs.on_b[overlap_of(cell)];
    const double size = overlap::length(spring);
    return size > 0 ? on_slave(cell, (1 / size) * spring) : cell.normal;
  }
  std::size_t overlap_of(const Cell& cell) const {
    return static_cast<std::size_t>(cell.overlap - springs.overlaps.data());
  }
  std::span<const Segment> segments_of(const Cell& cell) const {
    return springs.segments.subspan(cell.segment_start, cell.segment_end - cell.segment_start);
  }

  /// Eq. 38 with dl projected on s_c, so that both arcs, which share their ends, have one length and a pair
  /// carried along together does not slip. Where strips end within an overlap, or a face in a reflex corner,
  /// the arcs do not share their ends; the mean is the same whichever body comes first, and adds up to the
  /// whole along a boundary.
  void measure_arcs(std::span<const std::uint32_t> members, bool share_ends, double dt) {
    double projected[2] = {0, 0}, moved[2] = {0, 0}, arc = 0;
    for (const std::uint32_t member : members) {
      const Overlap& overlap = springs.overlaps[member];
      const Polygon& polygon = overlap.polygon;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const SideLabel label = polygon[i].side;
        const Piece& piece = overlap.piece[label.body];
        if (!piece.real(label.index)) continue;
        const Point start = polygon[i].at, end = polygon[i + 1 == polygon.size() ? 0 : i + 1].at;
        const double along = dot(end - start, tangent);
        const Point velocity_sum = piece.velocity_at(label.index, piece.lever(label.index, start)) +
                                   piece.velocity_at(label.index, piece.lever(label.index, end));
        projected[label.body] += along;
        moved[label.body] += along * dot(velocity_sum, tangent) / 2;
        arc += overlap::length(end - start);
      }
    }
    length = share_ends ? std::abs(projected[1]) : std::abs(projected[0] / 2 - projected[1] / 2);
    const bool measurable = std::min({std::abs(projected[0]), std::abs(projected[1]), length}) > 1e-9 * arc;
    slip_velocity = measurable ? moved[1] / projected[1] - moved[0] / projected[0] : 0;
    slip_increment = slip_velocity * dt;
    if (!measurable) length = 0;
  }

  /// By their sum the cells press no more than springs and dashpots do together: single ones that come out
  /// negative count nothing.
  void share_pressure() {
    double sum = 0;
    for (const Cell& cell : cells) sum += cell.pressed;
    const double pressed = std::max(0.0, dot(normal_on_b, normal()));
    for (Cell& cell : cells) cell.pressed *= sum > 0 ? pressed / sum : 0;
  }

  double penetration() const {
    double deepest = 0;
    for (const Cell& cell : cells) deepest = std::max(deepest, cell.depth);
    return deepest;
  }

  ContactReport report(Point tangential, double slip) const {
    // Where dashpots take all of the pressure away rounding must not make it pull.
    const Point at = foot_of_all(), pressing = dot(normal_on_b, normal()) > 0 ? normal_on_b : Point{0, 0};
    return {at.x,
            at.y,
            pressing.x,
            pressing.y,
            tangential.x,
            tangential.y,
            penetration(),
            slip != 0 ? 1.0 : 0.0,
            all_on_b.moment_about(at)};
  }

 private:
  /// The feet of all cells by their loads.
  Point foot_of_all() const {
    double load = 0;
    Point moment{0, 0};
    for (const Cell& cell : cells) {
      load += cell.pressed;
      moment = moment + cell.pressed * cell.pressed_at;
    }
    return load > 0 ? (1 / load) * moment : cells[0].foot;
  }
};

}  // namespace talus::overlap
