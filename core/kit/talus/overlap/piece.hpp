#pragma once

#include <talus/contact_model.hpp>
#include <talus/overlap/polygon.hpp>

namespace talus::overlap {

/// A convex piece of a body in the frame of its pair, with what the geometry asks of its sides.
struct Piece {
  std::vector<Point> at;        ///< [corner] m
  std::vector<Point> velocity;  ///< [corner] m/s
  std::vector<Point> tangent;   ///< [side] unit, from corner i to the next
  std::vector<double> length;   ///< [side] m
  const std::uint32_t* surface = nullptr;
  const std::uint32_t* cut = nullptr;
  std::uint32_t load_start = 0;  ///< first entry of this piece in ContactLoads::fx

  std::uint32_t size() const { return static_cast<std::uint32_t>(at.size()); }
  std::uint32_t next(std::uint32_t i) const { return i + 1 == size() ? 0 : i + 1; }
  /// A side that carries load: boundary, with a length.
  bool real(std::uint32_t side) const { return surface[side] != internal_side && length[side] > 0; }
  Point normal(std::uint32_t side) const { return {tangent[side].y, -tangent[side].x}; }  ///< outward
  /// Distance of a point behind the line of a side, m; positive inside.
  double depth(std::uint32_t side, Point p) const { return cross(tangent[side], p - at[side]); }
  /// Position of the foot of a point along a side: 0 at its start, 1 at its end.
  double lever(std::uint32_t side, Point p) const { return dot(tangent[side], p - at[side]) / length[side]; }
  Point velocity_at(std::uint32_t side, double lever_arm) const {
    return (1 - lever_arm) * velocity[side] + lever_arm * velocity[next(side)];
  }

  void read(const Boundaries& boundaries, std::uint32_t piece, Point offset, std::uint32_t first_load) {
    const std::uint32_t begin = boundaries.piece_start[piece], end = boundaries.piece_start[piece + 1];
    const std::uint32_t n = end - begin;
    at.resize(n), velocity.resize(n), tangent.resize(n), length.resize(n);
    for (std::uint32_t i = 0; i < n; ++i) {
      at[i] = Point{boundaries.x[begin + i], boundaries.y[begin + i]} + offset;
      velocity[i] = {boundaries.vx[begin + i], boundaries.vy[begin + i]};
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      const Point side = at[i + 1 == n ? 0 : i + 1] - at[i];
      length[i] = overlap::length(side);
      tangent[i] = length[i] > 0 ? (1 / length[i]) * side : Point{0, 0};
    }
    surface = boundaries.surface + begin;
    cut = boundaries.cut + begin;
    load_start = first_load;
  }
};

/// Adds loads at the corners of pieces.
struct LoadSink {
  double* fx;
  double* fy;

  void at_corner(const Piece& piece, std::uint32_t corner, Point force) const {
    fx[piece.load_start + corner] += force.x;
    fy[piece.load_start + corner] += force.y;
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

  /// A moment (counter-clockwise, N) as two opposite forces across a side.
  void couple(const Piece& piece, std::uint32_t side, double moment) const {
    const Point force = (-moment / piece.length[side]) * piece.normal(side);
    at_corner(piece, piece.next(side), force);
    at_corner(piece, side, -1.0 * force);
  }
};

}  // namespace talus::overlap
