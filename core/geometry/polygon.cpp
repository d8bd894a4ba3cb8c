#include "geometry/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus {

AreaMoments ring_moments(std::span<const Vec2> ring, Vec2 centre) {
  AreaMoments m{0, 0, 0, 0, 0, 0};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 p = ring[i] - centre;
    const Vec2& end = ring[i + 1 == ring.size() ? 0 : i + 1];
    const Vec2 q = end - centre;
    const double twice = p.x * q.y - p.y * q.x;
    m.area += twice / 2;
    m.x += twice * (p.x + q.x) / 6;
    m.y += twice * (p.y + q.y) / 6;
    m.xx += twice * (p.x * p.x + p.x * q.x + q.x * q.x) / 12;
    m.yy += twice * (p.y * p.y + p.y * q.y + q.y * q.y) / 12;
    m.xy += twice * (2 * p.x * p.y + p.x * q.y + q.x * p.y + 2 * q.x * q.y) / 24;
  }
  return m;
}

AreaMoments operator+(const AreaMoments& p, const AreaMoments& q) {
  return {p.area + q.area, p.x + q.x, p.y + q.y, p.xx + q.xx, p.xy + q.xy, p.yy + q.yy};
}

CentralMoments about_centroid(const AreaMoments& m) {
  return {m.area, m.xx - m.x * m.x / m.area, m.xy - m.x * m.y / m.area, m.yy - m.y * m.y / m.area};
}

namespace {

/// Convex hull by Andrew's monotone chain, counter-clockwise.
Ring convex_hull(std::span<const Vec2> points) {
  Ring sorted(points.begin(), points.end());
  std::sort(sorted.begin(), sorted.end(),
            [](Vec2 p, Vec2 q) { return p.x < q.x || (p.x == q.x && p.y < q.y); });
  Ring hull;
  const auto half = [&](auto begin, auto end) {
    const std::size_t start = hull.size();
    for (auto p = begin; p != end; ++p) {
      while (hull.size() >= start + 2) {
        const Vec2 o = hull[hull.size() - 2], q = hull.back();
        if ((q.x - o.x) * (p->y - o.y) - (q.y - o.y) * (p->x - o.x) > 0) break;
        hull.pop_back();
      }
      hull.push_back(*p);
    }
    hull.pop_back();
  };
  half(sorted.begin(), sorted.end());
  half(sorted.rbegin(), sorted.rend());
  return hull;
}

}  // namespace

double smallest_width(std::span<const Vec2> ring) {
  const Ring hull = convex_hull(ring);
  double width = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 a = hull[i], b = hull[i + 1 == hull.size() ? 0 : i + 1];
    const double dx = b.x - a.x, dy = b.y - a.y, size = std::sqrt(dx * dx + dy * dy);
    double height = 0;
    for (const Vec2& p : hull) height = std::max(height, (dx * (p.y - a.y) - dy * (p.x - a.x)) / size);
    width = std::min(width, height);
  }
  return width;
}

}  // namespace talus
