#pragma once

#include <talus/contact_model.hpp>
#include <talus/overlap/polygon.hpp>

#include <algorithm>

namespace talus::overlap {

/// A convex piece of a body seen in the frame of its pair: a view of the host's arrays.
class Piece {
 public:
  Piece() = default;
  Piece(const Boundaries& boundaries, std::uint32_t piece, Point offset, std::uint32_t first_load)
      : corners_(boundaries.corner + boundaries.piece_start[piece]),
        first_(boundaries.piece_start[piece]),
        size_(boundaries.piece_start[piece + 1] - first_),
        beyond_(boundaries.straight_beyond == nullptr ? nullptr
                                                      : boundaries.straight_beyond + std::size_t{4} * first_),
        offset_(offset),
        is_strip_(boundaries.is_strip[piece] != 0),
        load_start(first_load) {}

  std::uint32_t size() const { return size_; }
  /// A strip behind side 0, of a body of many elements.
  bool is_strip() const { return is_strip_; }
  std::uint32_t first_corner() const { return first_; }  ///< number among all corners
  std::uint32_t next(std::uint32_t i) const { return i + 1 == size_ ? 0 : i + 1; }
  std::uint32_t previous(std::uint32_t i) const { return i == 0 ? size_ - 1 : i - 1; }

  Point at(std::uint32_t i) const { return {corner(i).x + offset_.x, corner(i).y + offset_.y}; }
  Point velocity(std::uint32_t i) const { return {corner(i).vx, corner(i).vy}; }
  /// Unit tangent of side i, from corner i to the next.
  Point tangent(std::uint32_t i) const { return {corner(i).tangent_x, corner(i).tangent_y}; }
  Point normal(std::uint32_t side) const { return {tangent(side).y, -tangent(side).x}; }  ///< outward
  double length(std::uint32_t side) const { return corner(side).length; }
  /// m, how far the boundary goes on straight past the cut before or after a side; 0 where there is none.
  double straight_before(std::uint32_t side) const { return beyond(side, 0); }
  double straight_after(std::uint32_t side) const { return beyond(side, 1); }
  /// m, what an edge that lies flat on a side spans beyond that, where the boundary turns inwards.
  double spanned_before(std::uint32_t side) const { return beyond(side, 2); }
  double spanned_after(std::uint32_t side) const { return beyond(side, 3); }
  std::uint32_t surface(std::uint32_t side) const { return corner(side).surface; }
  std::uint32_t cut(std::uint32_t side) const { return corner(side).cut; }
  bool is_cut(std::uint32_t side) const { return surface(side) == internal_side; }
  /// A side that carries load: boundary, with a length.
  bool real(std::uint32_t side) const { return !is_cut(side) && length(side) > 0; }

  /// Whether all its sides are boundary: a body of its own, which moves by one affine map.
  bool whole() const {
    for (std::uint32_t i = 0; i < size_; ++i) {
      if (is_cut(i)) return false;
    }
    return true;
  }

  /// Distance of a point behind the line of a side, m; positive inside.
  double depth(std::uint32_t side, Point p) const { return cross(tangent(side), p - at(side)); }
  /// Position of the foot of a point along a side: 0 at its start, 1 at its end.
  double lever(std::uint32_t side, Point p) const { return dot(tangent(side), p - at(side)) / length(side); }
  /// Rate at which a force of 1 N/m in `direction` works that LoadSink::at_point puts at a point behind a
  /// side: of a piece that moves rigidly, the velocity of that point along the direction.
  double working_velocity(std::uint32_t side, Point point, Point direction) const {
    const Point stretch = velocity(next(side)) - velocity(side);
    const double couple = depth(side, point) * cross(-1.0 * normal(side), direction);
    return dot(direction, velocity_at(side, lever(side, point))) -
           couple / length(side) * dot(normal(side), stretch);
  }
  /// A point as a mean of corners 0, i and i + 1, those of the largest triangle of the fan from corner 0:
  /// exact for what is affine over the piece.
  struct Shares {
    std::uint32_t i;
    double of_0, of_i, of_next;
  };
  Shares shares_of(Point point) const {
    Shares shares{0, 0, 0, 0};
    double largest = 0;
    const auto edge = [&](std::uint32_t i) { return at(i) - at(0); };
    for (std::uint32_t i = 1; i + 1 < size_; ++i) {
      const double area = cross(edge(i), edge(i + 1));
      if (!(area > largest)) continue;
      largest = area;
      shares.i = i;
    }
    if (shares.i == 0) return {1, 1, 0, 0};
    const Point from = point - at(0);
    shares.of_i = cross(from, edge(shares.i + 1)) / largest;
    shares.of_next = cross(edge(shares.i), from) / largest;
    shares.of_0 = 1 - shares.of_i - shares.of_next;
    return shares;
  }
  /// Rate at which a force of 1 N/m in `direction` works that LoadSink::inside puts at a point.
  double velocity_inside(std::uint32_t side, Point point, Point direction) const {
    if (!whole()) return working_velocity(side, point, direction);
    const Shares s = shares_of(point);
    return dot(direction, s.of_0 * velocity(0) + s.of_i * velocity(s.i) + s.of_next * velocity(s.i + 1));
  }
  Point point_at(std::uint32_t side, double lever_arm) const {
    return (1 - lever_arm) * at(side) + lever_arm * at(next(side));
  }
  Point velocity_at(std::uint32_t side, double lever_arm) const {
    return (1 - lever_arm) * velocity(side) + lever_arm * velocity(next(side));
  }

 private:
  const BoundaryCorner& corner(std::uint32_t i) const { return corners_[i]; }
  double beyond(std::uint32_t side, std::uint32_t which) const {
    return beyond_ == nullptr ? 0 : beyond_[4 * side + which] * length(side);
  }

  const BoundaryCorner* corners_ = nullptr;
  std::uint32_t first_ = 0, size_ = 0;
  const double* beyond_ = nullptr;
  Point offset_{0, 0};
  bool is_strip_ = false;

 public:
  std::uint32_t load_start = 0;  ///< first entry of this piece in ContactLoads::corner
};

/// Adds loads at the corners of pieces.
struct LoadSink {
  CornerLoad* load;

  /// All corners of a pair's pieces free of load.
  void clear(const ContactBatch& batch, const BodyPair& pair) const {
    for (const PiecePair pieces : batch.piece_pairs.of(pair)) {
      const std::uint32_t* start = batch.boundaries.piece_start;
      const std::uint32_t count =
          start[pieces.a + 1] - start[pieces.a] + start[pieces.b + 1] - start[pieces.b];
      std::fill_n(load + pieces.load_start, count, CornerLoad{0, 0});
    }
  }

  void at_corner(const Piece& piece, std::uint32_t corner, Point force) const {
    CornerLoad& at = load[piece.load_start + corner];
    at.x += force.x;
    at.y += force.y;
  }

  /// A force on a side by the lever rule: exact, for the weights are affine along it.
  void on_side(const Piece& piece, std::uint32_t side, double lever_arm, Point force) const {
    at_corner(piece, side, (1 - lever_arm) * force);
    at_corner(piece, piece.next(side), lever_arm * force);
  }

  /// A force at a point off the side: the lever rule and a couple across the side, so that the line of action
  /// is kept and the loads on two bodies at one common point leave no moment.
  void at_point(const Piece& piece, std::uint32_t side, Point point, Point force) const {
    on_side(piece, side, piece.lever(side, point), force);
    const double height = piece.depth(side, point);
    const Point inward = -1.0 * piece.normal(side);
    couple(piece, side, height * cross(inward, force));
  }

  /// A force at a point: of the material there, where the piece is a body of its own; else as at_point().
  void inside(const Piece& piece, std::uint32_t side, Point point, Point force) const {
    if (!piece.whole()) {
      at_point(piece, side, point, force);
      return;
    }
    const Piece::Shares s = piece.shares_of(point);
    at_corner(piece, 0, s.of_0 * force);
    at_corner(piece, s.i, s.of_i * force);
    at_corner(piece, s.i + 1, s.of_next * force);
  }

  /// A moment (counter-clockwise, N) as two opposite forces across a side.
  void couple(const Piece& piece, std::uint32_t side, double moment) const {
    const Point force = (-moment / piece.length(side)) * piece.normal(side);
    at_corner(piece, piece.next(side), force);
    at_corner(piece, side, -1.0 * force);
  }
};

}  // namespace talus::overlap
