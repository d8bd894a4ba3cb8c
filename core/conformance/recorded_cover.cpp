#include "conformance/recorded_cover.hpp"

#include "plugin/registry.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace talus::conformance {
namespace {

using std::numbers::pi;

double cross(Point origin, Point p, Point q) {
  return (p.x - origin.x) * (q.y - origin.y) - (p.y - origin.y) * (q.x - origin.x);
}

void append(const Line& line, std::vector<double>& x, std::vector<double>& y,
            std::vector<std::uint32_t>& start) {
  for (const Point p : line) {
    x.push_back(p.x);
    y.push_back(p.y);
  }
  start.push_back(static_cast<std::uint32_t>(x.size()));
}

}  // namespace

DrawnBody::DrawnBody(std::vector<Line> drawn_rings, std::vector<Line> discontinuities)
    : rings(std::move(drawn_rings)), lines(std::move(discontinuities)) {
  for (int round = 0; round < 2; ++round) {  // the second takes the rounding of the first out
    const AreaMoments m = moments_of(rings);
    const Point centre{m.x / m.area, m.y / m.area};
    centroid_ = {centroid_.x + centre.x, centroid_.y + centre.y};
    for (std::vector<Line>* all : {&rings, &lines}) {
      for (Line& line : *all) {
        for (Point& p : line) p = {p.x - centre.x, p.y - centre.y};
      }
    }
  }
  moments_ = moments_of(rings);
  for (const Line& ring : rings) append(ring, x_, y_, ring_start_);
  for (const Line& line : lines) append(line, line_x_, line_y_, line_start_);
}

BodyShape DrawnBody::shape() const {
  return {{x_.data(), y_.data(), ring_start_.data(), static_cast<std::uint32_t>(rings.size())},
          moments_,
          {line_x_.data(), line_y_.data(), line_start_.data(), static_cast<std::uint32_t>(lines.size())},
          {node_x_.data(), node_y_.data(), reinterpret_cast<const std::uint32_t(*)[3]>(triangles_.data()),
           static_cast<std::uint32_t>(node_x_.size()), static_cast<std::uint32_t>(triangles_.size())}};
}

DrawnBody DrawnBody::meshed_square(std::uint32_t parts) {
  // About the origin as it is, so that nodes and outline are the same numbers.
  const auto at = [&](std::uint32_t i) { return 2.0 * i / parts - 1; };
  Line ring;
  for (std::uint32_t i = 0; i < parts; ++i) ring.push_back({at(i), -1});
  for (std::uint32_t i = 0; i < parts; ++i) ring.push_back({1, at(i)});
  for (std::uint32_t i = parts; i > 0; --i) ring.push_back({at(i), 1});
  for (std::uint32_t i = parts; i > 0; --i) ring.push_back({-1, at(i)});
  DrawnBody body({ring});
  for (std::uint32_t j = 0; j <= parts; ++j) {
    for (std::uint32_t i = 0; i <= parts; ++i) {
      body.node_x_.push_back(at(i) - body.centroid_.x);
      body.node_y_.push_back(at(j) - body.centroid_.y);
    }
  }
  for (std::uint32_t j = 0; j < parts; ++j) {
    for (std::uint32_t i = 0; i < parts; ++i) {
      const std::uint32_t low = j * (parts + 1) + i, high = low + parts + 1;
      body.triangles_.push_back({low, low + 1, high + 1});
      body.triangles_.push_back({low, high + 1, high});
    }
  }
  return body;
}

double DrawnBody::extent() const {
  double farthest = 0;
  for (const Point p : rings[0]) farthest = std::max(farthest, std::hypot(p.x, p.y));
  return farthest;
}

std::uint32_t RecordedCover::add_patch(double x, double y) noexcept {
  stars.push_back({x, y});
  return static_cast<std::uint32_t>(stars.size() - 1);
}

std::uint32_t RecordedCover::add_element(const std::uint32_t patches[3], const Region& region) noexcept {
  Element element{{patches[0], patches[1], patches[2]}, {}};
  for (std::uint32_t ring = 0; ring < region.ring_count; ++ring) {
    element.rings.emplace_back();
    for (std::uint32_t i = region.ring_start[ring]; i < region.ring_start[ring + 1]; ++i) {
      element.rings.back().push_back({region.x[i], region.y[i]});
    }
  }
  elements.push_back(std::move(element));
  return static_cast<std::uint32_t>(elements.size() - 1);
}

void RecordedCover::add_boundary_vertex(double x, double y, std::uint32_t element,
                                        std::uint32_t side) noexcept {
  open_.push_back({{x, y}, element, side});
}

void RecordedCover::close_boundary_loop() noexcept {
  loops.push_back(std::move(open_));
  open_.clear();
}

void RecordedCover::refuse(const char* why) noexcept {
  refusal = words_of_plugin(why != nullptr ? why : "");
}

void RecordedCover::steady_patch(std::uint32_t patch, const std::uint32_t to[3], const double w[3],
                                 double inertia_area) noexcept {
  steadied.push_back({patch, {to[0], to[1], to[2]}, {w[0], w[1], w[2]}, inertia_area});
}

std::array<double, 3> RecordedCover::weights(std::uint32_t element, Point at) const {
  const auto& patch = elements[element].patch;
  const Point a = stars[patch[0]], b = stars[patch[1]], c = stars[patch[2]];
  const double whole = cross(a, b, c);
  return {cross(b, c, at) / whole, cross(c, a, at) / whole, cross(a, b, at) / whole};
}

std::size_t RecordedCover::parts() const {
  std::vector<std::size_t> root(stars.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t patch) {
    while (root[patch] != patch) patch = root[patch] = root[root[patch]];
    return patch;
  };
  for (const Element& element : elements) {
    root[find(element.patch[0])] = find(element.patch[1]);
    root[find(element.patch[1])] = find(element.patch[2]);
  }
  std::size_t count = 0;
  for (std::size_t patch = 0; patch < root.size(); ++patch) count += find(patch) == patch ? 1 : 0;
  return count;
}

bool is_in(const std::vector<Line>& rings, Point at) {
  bool inside = false;
  for (const Line& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      Point p = ring[i], q = ring[(i + 1) % ring.size()];
      if (p.y > q.y) std::swap(p, q);
      if (p.y <= at.y && at.y < q.y && cross(p, q, at) > 0) inside = !inside;
    }
  }
  return inside;
}

AreaMoments moments_of(const std::vector<Line>& rings) {
  AreaMoments sum{};
  const Point origin = rings[0][0];  // sums about it lose nothing to cancellation
  for (const Line& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point p{ring[i].x - origin.x, ring[i].y - origin.y};
      const Point& next = ring[(i + 1) % ring.size()];
      const Point q{next.x - origin.x, next.y - origin.y};
      const double part = (p.x * q.y - q.x * p.y) / 2;
      sum.area += part;
      sum.x += part * (p.x + q.x) / 3;
      sum.y += part * (p.y + q.y) / 3;
      sum.xx += part * (p.x * p.x + p.x * q.x + q.x * q.x) / 6;
      sum.xy += part * (2 * p.x * p.y + p.x * q.y + q.x * p.y + 2 * q.x * q.y) / 12;
      sum.yy += part * (p.y * p.y + p.y * q.y + q.y * q.y) / 6;
    }
  }
  const auto [ox, oy] = origin;
  sum.xx += 2 * ox * sum.x + ox * ox * sum.area;
  sum.xy += ox * sum.y + oy * sum.x + ox * oy * sum.area;
  sum.yy += 2 * oy * sum.y + oy * oy * sum.area;
  sum.x += ox * sum.area;
  sum.y += oy * sum.area;
  return sum;
}

double distance(Point p, Point q) {
  return std::hypot(q.x - p.x, q.y - p.y);
}

double distance_from_segment(Point p, Point start, Point end) {
  const double dx = end.x - start.x, dy = end.y - start.y;
  const double share = ((p.x - start.x) * dx + (p.y - start.y) * dy) / (dx * dx + dy * dy);
  const double t = std::clamp(share, 0.0, 1.0);
  return distance(p, {start.x + t * dx, start.y + t * dy});
}

Line regular_polygon(int corners, double radius, Point centre, double angle) {
  Line ring;
  for (int i = 0; i < corners; ++i) {
    const double at = angle + 2 * pi * i / corners;
    ring.push_back({centre.x + radius * std::cos(at), centre.y + radius * std::sin(at)});
  }
  return ring;
}

std::vector<Line> turned(std::vector<Line> lines, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  for (Line& line : lines) {
    for (Point& p : line) p = {c * p.x - s * p.y, s * p.x + c * p.y};
  }
  return lines;
}

}  // namespace talus::conformance
