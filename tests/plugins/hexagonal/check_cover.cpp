#include "recorded_cover.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace talus::covered {
namespace {

struct Side {
  Point start, end;
};

/// [side as CoverSink numbers it]; the last point of a discontinuity starts none.
std::vector<Side> sides_of(const DrawnBody& body) {
  std::vector<Side> sides;
  for (const Line& ring : body.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) sides.push_back({ring[i], ring[(i + 1) % ring.size()]});
  }
  for (const Line& line : body.lines) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      sides.push_back({line[i], line[std::min(i + 1, line.size() - 1)]});
    }
  }
  return sides;
}

std::size_t outline_sides(const DrawnBody& body) {
  std::size_t count = 0;
  for (const Line& ring : body.rings) count += ring.size();
  return count;
}

void check_same(const AreaMoments& made, const AreaMoments& wanted, double extent, double share) {
  const double area = share * wanted.area;
  REQUIRE(std::fabs(made.area - wanted.area) <= area);
  REQUIRE(std::fabs(made.x - wanted.x) <= area * extent);
  REQUIRE(std::fabs(made.y - wanted.y) <= area * extent);
  REQUIRE(std::fabs(made.xx - wanted.xx) <= area * extent * extent);
  REQUIRE(std::fabs(made.xy - wanted.xy) <= area * extent * extent);
  REQUIRE(std::fabs(made.yy - wanted.yy) <= area * extent * extent);
}

void check_elements(const DrawnBody& body, const RecordedCover& cover, double size, double snap) {
  AreaMoments sum{};
  std::vector<int> used(cover.stars.size(), 0);
  for (std::uint32_t e = 0; e < cover.elements.size(); ++e) {
    const auto& element = cover.elements[e];
    const AreaMoments m = moments_of(element.rings);
    REQUIRE(m.area > 0);
    sum = {sum.area + m.area, sum.x + m.x, sum.y + m.y, sum.xx + m.xx, sum.xy + m.xy, sum.yy + m.yy};
    for (std::size_t k = 0; k < 3; ++k) {
      ++used[element.patch[k]];
      const Point p = cover.stars[element.patch[k]], q = cover.stars[element.patch[(k + 1) % 3]];
      REQUIRE(distance(p, q) == Approx(size).epsilon(1e-9));
      REQUIRE(cover.weights(e, q)[(k + 1) % 3] == Approx(1));
    }
    for (const Line& ring : element.rings) {
      REQUIRE(ring.size() >= 3);
      for (const Point at : ring) {
        for (const double w : cover.weights(e, at)) REQUIRE(w >= -snap);
      }
    }
  }
  check_same(sum, body.shape().moments, body.extent(), 1e-12);
  REQUIRE(std::count(used.begin(), used.end(), 0) == 0);
}

/// Displacements of patches without any pattern: only true continuity passes.
Point scattered(std::uint32_t patch) {
  return {std::fmod(0.5 + 0.6180339887498949 * patch, 1.0),
          std::fmod(0.25 + 0.4142135623730950 * patch, 1.0)};
}

Point displaced(const RecordedCover& cover, std::uint32_t element, Point at) {
  const auto w = cover.weights(element, at);
  Point sum{0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const Point d = scattered(cover.elements[element].patch[k]);
    sum = {sum.x + w[k] * d.x, sum.y + w[k] * d.y};
  }
  return sum;
}

void check_boundary_side(const RecordedCover& cover, double size, double snap, const BoundaryVertex& from,
                         const BoundaryVertex& to, const Side& side) {
  // It lies on the side it follows, and on the rim of its element.
  const double near = snap * size;
  REQUIRE(distance_from_segment(from.at, side.start, side.end) <= near);
  REQUIRE(distance_from_segment(to.at, side.start, side.end) <= near);
  const Point middle{(from.at.x + to.at.x) / 2, (from.at.y + to.at.y) / 2};
  double closest = size;
  for (const Line& ring : cover.elements[from.element].rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      closest = std::min(closest, distance_from_segment(middle, ring[i], ring[(i + 1) % ring.size()]));
    }
  }
  REQUIRE(closest <= near);

  // Both elements say the same of the vertex where one passes to the other.
  const Point p = displaced(cover, from.element, to.at), q = displaced(cover, to.element, to.at);
  REQUIRE(distance(p, q) <= 4 * snap);

  // Weights reproduce an affine field.
  const auto w = cover.weights(from.element, from.at);
  const auto& patch = cover.elements[from.element].patch;
  Point sum{0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const Point star = cover.stars[patch[k]];
    sum = {sum.x + w[k] * star.x, sum.y + w[k] * star.y};
  }
  REQUIRE(w[0] + w[1] + w[2] == Approx(1).epsilon(1e-12));
  REQUIRE(distance(sum, from.at) <= 1e-12 * (size + std::hypot(from.at.x, from.at.y)));
}

void check_boundary(const DrawnBody& body, const RecordedCover& cover, double size, double snap) {
  const std::vector<Side> sides = sides_of(body);
  const std::size_t first_cut = outline_sides(body);
  double sides_length = 0;
  std::map<std::uint32_t, Point> along_cut;
  std::vector<Line> loops;
  for (const auto& loop : cover.loops) {
    REQUIRE(loop.size() >= 3);
    loops.emplace_back();
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const BoundaryVertex &from = loop[i], &to = loop[(i + 1) % loop.size()];
      REQUIRE(from.side < sides.size());
      REQUIRE(from.element < cover.elements.size());
      const Side& side = sides[from.side];
      check_boundary_side(cover, size, snap, from, to, side);
      loops.back().push_back(from.at);
      const Point step{to.at.x - from.at.x, to.at.y - from.at.y};
      if (from.side < first_cut) {
        REQUIRE(step.x * (side.end.x - side.start.x) + step.y * (side.end.y - side.start.y) > 0);
        sides_length += std::hypot(step.x, step.y);
      } else {
        Point& sum = along_cut[from.side];
        sum = {sum.x + step.x, sum.y + step.y};
      }
    }
  }
  // The loops surround the body; what goes in along a discontinuity comes back along it.
  check_same(moments_of(loops), body.shape().moments, body.extent(), 1e-12);
  REQUIRE(sides_length == Approx(outline_length(body)).epsilon(1e-9));
  for (const auto& [side, sum] : along_cut) REQUIRE(std::hypot(sum.x, sum.y) <= 100 * snap * size);
}

void check_steadied(const RecordedCover& cover, double size) {
  std::vector<double> carried = row_sums(cover);
  std::vector<int> times(cover.stars.size(), 0);
  for (const Steadied& one : cover.steadied) ++times[one.patch];
  for (const Steadied& one : cover.steadied) {
    REQUIRE(times[one.patch] == 1);
    REQUIRE(one.weights[0] + one.weights[1] + one.weights[2] == Approx(1).epsilon(1e-12));
    Point sum{0, 0};
    for (std::size_t k = 0; k < 3; ++k) {
      REQUIRE(times[one.to[k]] == 0);
      const Point star = cover.stars[one.to[k]];
      sum = {sum.x + one.weights[k] * star.x, sum.y + one.weights[k] * star.y};
      if (std::isinf(one.inertia_area)) {
        carried[one.to[k]] += one.weights[k] * row_sums(cover)[one.patch];
      }
    }
    REQUIRE(distance(sum, cover.stars[one.patch]) <= 1e-10 * size);
    REQUIRE(one.inertia_area > 0);
  }
  for (std::size_t patch = 0; patch < carried.size(); ++patch) {
    if (times[patch] == 0) REQUIRE(carried[patch] > 0);
  }
}

}  // namespace

void check_cover(const DrawnBody& body, const RecordedCover& cover, double size, double snap) {
  REQUIRE(cover.refusal == "");
  REQUIRE(!cover.rigid);
  check_elements(body, cover, size, snap);
  check_boundary(body, cover, size, snap);
  check_steadied(cover, size);
}

}  // namespace talus::covered
