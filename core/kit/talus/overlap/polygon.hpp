#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
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

/// Where a side of a clipped polygon comes from: side `index` of body a (0) or b (1), or a line that divides
/// an overlap.
struct SideLabel {
  std::uint32_t body;
  std::uint32_t index;
};

/// Added to the body in the label of a line between two of its sides; the index is that of the other side.
inline constexpr std::uint32_t between_sides = 2;

/// A corner of a clipped polygon; `side` tells where the side that starts here comes from.
struct Corner {
  Point at;
  SideLabel side;
};

/// A convex polygon, counter-clockwise, in memory that is kept: nothing is allocated once it has grown.
class Polygon {
 public:
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  void clear() { size_ = 0; }
  Corner& operator[](std::size_t i) { return corners_[i]; }
  const Corner& operator[](std::size_t i) const { return corners_[i]; }
  const Corner* begin() const { return corners_.data(); }
  const Corner* end() const { return corners_.data() + size_; }
  std::size_t next(std::size_t i) const { return i + 1 == size_ ? 0 : i + 1; }

  void make_room(std::size_t corners) {
    if (corners_.size() < corners) corners_.resize(2 * corners);
  }
  void append(const Corner& corner) { corners_[size_++] = corner; }  ///< after make_room
  void assign(const Polygon& other) {
    make_room(other.size_);
    size_ = other.size_;
    for (std::size_t i = 0; i < size_; ++i) corners_[i] = other.corners_[i];
  }
  void swap(Polygon& other) {
    corners_.swap(other.corners_);
    std::swap(size_, other.size_);
  }

 private:
  std::vector<Corner> corners_;  // capacity; the polygon is the first size_ of them
  std::size_t size_ = 0;
};

/// Cuts polygons by lines; keeps its own buffers.
class Clipper {
 public:
  /// Keeps the part of `polygon` where height(point) ≤ 0; height is affine. The side along the cut gets
  /// `label`.
  template <class Height>
  void clip(Polygon& polygon, SideLabel label, const Height& height) {
    const std::size_t n = polygon.size();
    if (heights_.size() < n) heights_.resize(2 * n);
    std::size_t outside = 0;
    for (std::size_t i = 0; i < n; ++i) {
      heights_[i] = height(polygon[i].at);
      outside += heights_[i] <= 0 ? 0 : 1;
    }
    if (outside == 0) return;
    clipped_.clear();
    clipped_.make_room(2 * n);  // a sliver that rounding bent can be cut more than twice
    for (std::size_t i = 0; i < n && outside < n; ++i) {
      const std::size_t j = polygon.next(i);
      const Corner& here = polygon[i];
      const double h = heights_[i], h_next = heights_[j];
      const bool inside = h <= 0, next_inside = h_next <= 0;
      if (inside) clipped_.append(here);
      if (inside != next_inside) {
        clipped_.append(
            {here.at + (h / (h - h_next)) * (polygon[j].at - here.at), inside ? label : here.side});
      }
    }
    if (clipped_.size() < 3) clipped_.clear();
    polygon.swap(clipped_);
  }

 private:
  Polygon clipped_;
  std::vector<double> heights_;
};

struct AreaCentroid {
  double area;
  Point centroid;
};

/// Area and centroid about the first corner, so that a sliver far from the origin loses no digits. A sliver
/// as thin as the rounding of its corners is not quite convex: triangles that come out negative count
/// nothing, or areas would cancel where moments do not and the centroid would lie anywhere.
inline AreaCentroid area_centroid(const Polygon& polygon) {
  double twice_area = 0;
  Point moment{0, 0};
  const Point origin = polygon[0].at;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Point p = polygon[i].at - origin, q = polygon[i + 1].at - origin;
    const double triangle = std::max(0.0, cross(p, q));
    twice_area += triangle;
    moment = moment + triangle * (p + q);
  }
  if (!(twice_area > 0)) return {0, origin};
  return {twice_area / 2, origin + (1 / (3 * twice_area)) * moment};
}

}  // namespace talus::overlap
