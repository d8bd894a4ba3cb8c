#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

namespace talus::overlap {

struct Point {
  double x, y;
};

constexpr Point operator+(Point p, Point q) {
  return {p.x + q.x, p.y + q.y};
}
constexpr Point operator-(Point p, Point q) {
  return {p.x - q.x, p.y - q.y};
}
constexpr Point operator*(double s, Point p) {
  return {s * p.x, s * p.y};
}
constexpr double dot(Point p, Point q) {
  return p.x * q.x + p.y * q.y;
}
constexpr double cross(Point p, Point q) {
  return p.x * q.y - p.y * q.x;
}
inline double length(Point p) {
  return std::sqrt(dot(p, p));
}

/// Where a side of a clipped polygon comes from: side `index` of body a (0) or b (1), or a division line.
struct SideLabel {
  std::uint32_t body;
  std::uint32_t index;
};

inline constexpr SideLabel division_line{2, 0};

/// A corner of a clipped polygon; `side` tells where the side that starts here comes from.
struct Corner {
  Point at;
  SideLabel side;
};

using Polygon = std::vector<Corner>;  // convex, counter-clockwise

/// Keeps the part of `from` where height(point) ≤ 0; height is affine. The side along the cut gets `label`.
template <class Height>
void clip(const Polygon& from, Polygon& to, SideLabel label, const Height& height) {
  to.clear();
  const std::size_t n = from.size();
  if (n == 0) return;
  double h = height(from[0].at);
  for (std::size_t i = 0; i < n; ++i) {
    const Corner& here = from[i];
    const Corner& next = from[i + 1 == n ? 0 : i + 1];
    const double h_next = height(next.at);
    const bool inside = h <= 0, next_inside = h_next <= 0;
    if (inside) to.push_back(here);
    if (inside != next_inside) {
      const Point crossing = here.at + (h / (h - h_next)) * (next.at - here.at);
      to.push_back({crossing, inside ? label : here.side});
    }
    h = h_next;
  }
  if (to.size() < 3) to.clear();
}

struct AreaCentroid {
  double area;
  Point centroid;
};

/// Area and centroid about the first corner, so that a sliver far from the origin loses no digits.
inline AreaCentroid area_centroid(const Polygon& polygon) {
  double twice_area = 0;
  Point moment{0, 0};
  const Point origin = polygon[0].at;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Point p = polygon[i].at - origin, q = polygon[i + 1].at - origin;
    const double triangle = cross(p, q);
    twice_area += triangle;
    moment = moment + triangle * (p + q);
  }
  if (!(twice_area > 0)) return {0, origin};
  return {twice_area / 2, origin + (1 / (3 * twice_area)) * moment};
}

}  // namespace talus::overlap
