#pragma once

#include <array>
#include <compare>
#include <cstdint>

namespace talus::hexagonal {

/// m, relative to the reference centre of the body.
struct Point {
  double x, y;
};

/// Place in the lattice: a steps along its first direction, b along the second, 60° from it.
struct LatticePoint {
  double a, b;
};

/// The same in whole steps of 2⁻³⁰ of the size. All questions of order and connection are decided on these
/// numbers, without rounding; the lattice lines are a, b and a + b divisible by `unit`.
struct GridPoint {
  std::int64_t a, b;

  friend bool operator==(const GridPoint&, const GridPoint&) = default;
};

inline constexpr std::int64_t unit = std::int64_t{1} << 30;

/// What is closer than this many grid steps coincides. The finest is 2e-9 of the size, far above the rounding
/// of coordinates; the others are for bodies with several things that nearly coincide in one place.
inline constexpr std::int64_t tolerances[] = {2, 16, 128};

__extension__ typedef __int128 Wide;

inline Wide cross(GridPoint origin, GridPoint p, GridPoint q) {
  return Wide{p.a - origin.a} * (q.b - origin.b) - Wide{p.b - origin.b} * (q.a - origin.a);
}

inline Wide dot(GridPoint origin, GridPoint p, GridPoint q) {
  return Wide{p.a - origin.a} * (q.a - origin.a) + Wide{p.b - origin.b} * (q.b - origin.b);
}

/// Row j and column i of parallelograms, each of which is a lower and an upper triangle.
struct Cell {
  std::int32_t j, i;

  friend auto operator<=>(const Cell&, const Cell&) = default;
};

inline std::int32_t cell_index(std::int64_t coordinate) {
  return static_cast<std::int32_t>(coordinate >> 30);
}

struct LatticeVertex {
  std::int32_t i, j;
};

struct Triangle {
  Cell cell{};
  bool upper = false;

  friend auto operator<=>(const Triangle&, const Triangle&) = default;

  /// Counter-clockwise.
  std::array<LatticeVertex, 3> corners() const {
    const std::int32_t i = cell.i, j = cell.j;
    if (upper) return {{{i + 1, j + 1}, {i, j + 1}, {i + 1, j}}};
    return {{{i, j}, {i + 1, j}, {i, j + 1}}};
  }
};

/// Side of triangles from vertex (i, j) in direction 0: along a, 1: along b; 2: from (i + 1, j) to (i, j +
/// 1).
struct LatticeSide {
  std::int32_t i = 0, j = 0;
  std::uint8_t direction = 3;  ///< 3: no side of the lattice

  explicit operator bool() const { return direction < 3; }
  friend bool operator==(const LatticeSide&, const LatticeSide&) = default;

  GridPoint start() const { return {(direction == 2 ? i + 1 : i) * unit, j * unit}; }
  GridPoint end() const { return {(direction == 0 ? i + 1 : i) * unit, (direction == 0 ? j : j + 1) * unit}; }

  Triangle lower() const { return {{j, i}, false}; }
  Triangle upper() const { return {{direction == 0 ? j - 1 : j, direction == 1 ? i - 1 : i}, true}; }
  /// Whether the upper triangle is the one on the left.
  bool upper_on_left() const { return direction == 1; }

  /// Which corners of the lower triangle its start and end are; of the upper one they are end and start.
  std::array<std::uint8_t, 2> corners_of_lower() const {
    if (direction == 0) return {0, 1};
    if (direction == 1) return {0, 2};
    return {1, 2};
  }
};

/// The regular triangular lattice.
class Lattice {
 public:
  /// `vertex` is the place of any of its vertices; `angle`, rad, turns its first direction from the x axis.
  Lattice(double size, Point vertex, double angle);

  double size() const { return size_; }
  LatticePoint place(Point point) const;
  Point point(GridPoint place) const;
  Point point(LatticeVertex vertex) const { return point(GridPoint{vertex.i * unit, vertex.j * unit}); }

 private:
  LatticePoint unshifted(Point point) const;

  double size_, cosine_, sine_;
  LatticePoint shift_{0, 0};  ///< of the origin of the grid, within one cell
};

/// Whole grid steps; onto lattice lines and vertices within the tolerance.
GridPoint to_grid(LatticePoint place, std::int64_t tolerance);
GridPoint onto_lattice(GridPoint place, std::int64_t tolerance);

/// How far a place is within a triangle, in heights of it; negative outside.
double depth_in(const Triangle& triangle, LatticePoint place);

/// The triangle of a place, and how far it is from the nearest lattice line, grid steps.
Triangle triangle_at(GridPoint place);
std::int64_t distance_from_lines(GridPoint place);

}  // namespace talus::hexagonal
