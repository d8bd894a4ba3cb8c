#include "geometry/outlines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

// Long double keeps the sign of near-degenerate orientations of coordinates that were written as doubles.
using Real = long double;

Real cross(Vec2 o, Vec2 a, Vec2 b) {
  return (Real(a.x) - o.x) * (Real(b.y) - o.y) - (Real(a.y) - o.y) * (Real(b.x) - o.x);
}

int side(Vec2 o, Vec2 a, Vec2 b) {
  const Real value = cross(o, a, b);
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

bool in_box(Vec2 a, Vec2 b, Vec2 p) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

bool segments_meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const int c_side = side(a, b, c), d_side = side(a, b, d), a_side = side(c, d, a), b_side = side(c, d, b);
  if (c_side * d_side < 0 && a_side * b_side < 0) return true;
  return (c_side == 0 && in_box(a, b, c)) || (d_side == 0 && in_box(a, b, d)) ||
         (a_side == 0 && in_box(c, d, a)) || (b_side == 0 && in_box(c, d, b));
}

struct OutlineEdge {
  std::size_t loop, index;
  Vec2 from, to;
  double left() const { return std::min(from.x, to.x); }
  double right() const { return std::max(from.x, to.x); }
};

std::string name_of(const OutlineEdge& edge, bool has_holes) {
  if (edge.loop != 0) return fmt::format("edge {} of hole {}", edge.index, edge.loop - 1);
  return fmt::format("edge {}{}", edge.index, has_holes ? " of the outer boundary" : "");
}

std::vector<OutlineEdge> edges_of(const Loops& loops) {
  std::vector<OutlineEdge> edges;
  for (std::size_t loop = 0; loop < loops.size(); ++loop) {
    const Ring& ring = loops[loop];
    for (std::size_t i = 0; i < ring.size(); ++i) {
      edges.push_back({loop, i, ring[i], ring[(i + 1) % ring.size()]});
    }
  }
  return edges;
}

constexpr const char* no_area = "the polygon has no area: its edges enclose nothing";

/// Whether all vertices lie on one line. Other polygons without area cross themselves, which says more.
bool is_flat(const Ring& ring, double size) {
  const Vec2 first = ring[0];
  const Vec2 farthest = *std::max_element(ring.begin(), ring.end(), [&](Vec2 a, Vec2 b) {
    return std::hypot(a.x - first.x, a.y - first.y) < std::hypot(b.x - first.x, b.y - first.y);
  });
  return std::all_of(ring.begin(), ring.end(),
                     [&](Vec2 p) { return std::abs(cross(first, farthest, p)) <= 1e-12 * size * size; });
}

/// Vertices that follow each other on one point, and edges that run back over the one before.
void faults_of_ring(std::size_t loop, const Ring& ring, std::vector<ShapeFault>& faults) {
  const std::size_t count = ring.size();
  const double size = extent({ring});
  bool short_edge = false;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = (i + 1) % count;
    if (std::hypot(ring[next].x - ring[i].x, ring[next].y - ring[i].y) <= 1e-12 * size) {
      faults.push_back({loop, next,
                        fmt::format("edge {} has no length: vertices {} and {} are the same point ({}, {})",
                                    i, i, next, ring[i].x, ring[i].y)});
      short_edge = true;
    }
  }
  if (short_edge) return;
  if (is_flat(ring, size)) {
    faults.push_back({loop, std::nullopt, no_area});
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = (i + 1) % count;
    const Vec2 before = ring[i], at = ring[next], after = ring[(next + 1) % count];
    const Real ahead =
        (Real(at.x) - before.x) * (Real(after.x) - at.x) + (Real(at.y) - before.y) * (Real(after.y) - at.y);
    if (ahead < 0 && std::abs(cross(before, at, after)) <= 1e-12L * std::abs(ahead)) {
      faults.push_back(
          {loop, next, fmt::format("edges {} and {} run back over each other at vertex {}", i, next, next)});
    }
  }
}

bool neighbours(const OutlineEdge& a, const OutlineEdge& b, const Loops& loops) {
  if (a.loop != b.loop) return false;
  const std::size_t count = loops[a.loop].size();
  return (a.index + 1) % count == b.index || (b.index + 1) % count == a.index;
}

/// The first two edges that meet without being neighbours.
std::optional<ShapeFault> crossing_fault(const Loops& loops) {
  std::vector<OutlineEdge> edges = edges_of(loops);
  std::stable_sort(edges.begin(), edges.end(),
                   [](const OutlineEdge& a, const OutlineEdge& b) { return a.left() < b.left(); });
  std::vector<const OutlineEdge*> active;
  for (const OutlineEdge& edge : edges) {
    std::erase_if(active, [&](const OutlineEdge* other) { return other->right() < edge.left(); });
    for (const OutlineEdge* other : active) {
      if (neighbours(edge, *other, loops) || !segments_meet(edge.from, edge.to, other->from, other->to))
        continue;
      const bool swap = std::pair(edge.loop, edge.index) < std::pair(other->loop, other->index);
      const OutlineEdge &first = swap ? edge : *other, &second = swap ? *other : edge;
      const bool has_holes = loops.size() > 1;
      const std::string edges_named = name_of(first, has_holes) + " and " + name_of(second, has_holes);
      const char* consequence = first.loop == second.loop ? ": the polygon intersects itself" : "";
      if (same(first.from, second.from)) {
        return ShapeFault{second.loop, std::nullopt,
                          fmt::format("{} start at the same point ({}, {}){}", edges_named, first.from.x,
                                      first.from.y, consequence)};
      }
      return ShapeFault{second.loop, std::nullopt,
                        fmt::format("{} cross or touch{}", edges_named, consequence)};
    }
    active.push_back(&edge);
  }
  return std::nullopt;
}

/// Even-odd rule; points on the boundary may come out either way.
bool within(const Ring& ring, Vec2 p) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
    if (a.y > b.y) std::swap(a, b);
    if (a.y <= p.y && p.y < b.y && cross(a, b, p) > 0) inside = !inside;
  }
  return inside;
}

void faults_of_holes(const Loops& loops, std::vector<ShapeFault>& faults) {
  for (std::size_t hole = 1; hole < loops.size(); ++hole) {
    if (!within(loops[0], loops[hole][0])) {
      faults.push_back(
          {hole, std::nullopt, "the hole lies outside the polygon: a hole must be within its body"});
      continue;
    }
    for (std::size_t other = 1; other < loops.size(); ++other) {
      if (other != hole && within(loops[other], loops[hole][0])) {
        faults.push_back({hole, std::nullopt, fmt::format("the hole lies within hole {}", other - 1)});
      }
    }
  }
}

}  // namespace

double signed_area(const Ring& ring) {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    twice += static_cast<double>(cross(ring[0], ring[i], ring[i + 1]));
  }
  return twice / 2;
}

std::vector<ShapeFault> shape_faults(const Loops& loops) {
  std::vector<ShapeFault> faults;
  for (std::size_t loop = 0; loop < loops.size(); ++loop) faults_of_ring(loop, loops[loop], faults);
  if (!faults.empty()) return faults;
  if (const auto crossing = crossing_fault(loops)) return {*crossing};
  for (std::size_t loop = 0; loop < loops.size(); ++loop) {
    const double size = extent({loops[loop]});
    if (std::abs(signed_area(loops[loop])) <= 1e-12 * size * size) {
      faults.push_back({loop, std::nullopt, no_area});
    }
  }
  if (!faults.empty()) return faults;
  faults_of_holes(loops, faults);
  return faults;
}

bool contains(const Loops& loops, Vec2 point, double margin) {
  for (const OutlineEdge& edge : edges_of(loops)) {
    if (distance_from(point, edge.from, edge.to) <= margin) return true;
  }
  bool inside = false;
  for (const Ring& ring : loops) inside = inside != within(ring, point);
  return inside;
}

double extent(const Loops& loops) {
  Vec2 low = loops[0][0], high = low;
  for (const Vec2 vertex : loops[0]) {
    low = {std::min(low.x, vertex.x), std::min(low.y, vertex.y)};
    high = {std::max(high.x, vertex.x), std::max(high.y, vertex.y)};
  }
  return std::max(high.x - low.x, high.y - low.y);
}

}  // namespace talus
