#include "curves.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace talus::hexagonal {
namespace {

constexpr double most_triangles = 5e6;

/// Rectangle in lattice coordinates.
struct Box {
  double low[2], high[2];
};

/// The part of a segment in the box, as a range of shares of it; false if there is none.
bool clip(const Box& box, LatticePoint p, LatticePoint q, double& from, double& to) {
  const double start[2] = {p.a, p.b}, step[2] = {q.a - p.a, q.b - p.b};
  from = 0;
  to = 1;
  for (int axis = 0; axis < 2; ++axis) {
    if (step[axis] == 0) {
      if (start[axis] < box.low[axis] || start[axis] > box.high[axis]) return false;
      continue;
    }
    double enters = (box.low[axis] - start[axis]) / step[axis];
    double leaves = (box.high[axis] - start[axis]) / step[axis];
    if (enters > leaves) std::swap(enters, leaves);
    from = std::max(from, enters);
    to = std::min(to, leaves);
  }
  return from < to;
}

void check_count(double area, double length, double size) {
  // A line crosses 2.2 sides of the lattice per size, on average over its direction.
  const double triangles = area / (std::sqrt(3.0) / 4 * size * size) + 2.2 * length / size;
  if (triangles <= most_triangles) return;
  char words[200];
  std::snprintf(words, sizeof words,
                "a lattice of size %g m needs some %.2g triangles, more than %g; take a larger size", size,
                triangles, most_triangles);
  throw Refusal(words);
}

/// The outline's box in the lattice, and a cell around it.
Box surroundings(const Region& outline, const Lattice& lattice) {
  Box box{{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
  for (std::uint32_t i = 0; i < vertex_count(outline); ++i) {
    const auto [a, b] = lattice.place({outline.x[i], outline.y[i]});
    box.low[0] = std::min(box.low[0], a - 1);
    box.high[0] = std::max(box.high[0], a + 1);
    box.low[1] = std::min(box.low[1], b - 1);
    box.high[1] = std::max(box.high[1], b + 1);
  }
  return box;
}

double outline_length(const Region& outline) {
  double length = 0;
  for (std::uint32_t ring = 0; ring < outline.ring_count; ++ring) {
    for (std::uint32_t i = outline.ring_start[ring]; i < outline.ring_start[ring + 1]; ++i) {
      const std::uint32_t next = i + 1 < outline.ring_start[ring + 1] ? i + 1 : outline.ring_start[ring];
      length += distance({outline.x[i], outline.y[i]}, {outline.x[next], outline.y[next]});
    }
  }
  return length;
}

/// Vertices that share a node are one vertex; farther apart than rounding, that would change the shape.
void check_vertices(const Curves& curves, const Region& outline, double size) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> by_node;
  for (std::uint32_t i = 0; i < vertex_count(outline); ++i) by_node.push_back({curves.outline_nodes[i], i});
  std::sort(by_node.begin(), by_node.end());
  for (std::size_t k = 0; k + 1 < by_node.size(); ++k) {
    const std::uint32_t i = by_node[k].second, j = by_node[k + 1].second;
    if (by_node[k].first != by_node[k + 1].first) continue;
    const double apart = distance({outline.x[i], outline.y[i]}, {outline.x[j], outline.y[j]});
    if (apart <= 1e-12 * size) continue;
    char words[200];
    std::snprintf(
        words, sizeof words,
        "vertices %u and %u of the outline are %g m apart, too close for a lattice of size %g m; join "
        "them or take a smaller size",
        i, j, apart, size);
    throw Refusal(words);
  }
}

void add_outline(Curves& curves, Nodes& nodes, const Region& outline, const Lattice& lattice) {
  for (std::uint32_t i = 0; i < vertex_count(outline); ++i) {
    curves.outline_nodes.push_back(
        nodes.near(to_grid(lattice.place({outline.x[i], outline.y[i]}), nodes.tolerance())));
  }
  check_vertices(curves, outline, lattice.size());
  for (std::uint32_t ring = 0; ring < outline.ring_count; ++ring) {
    for (std::uint32_t i = outline.ring_start[ring]; i < outline.ring_start[ring + 1]; ++i) {
      const std::uint32_t next = i + 1 < outline.ring_start[ring + 1] ? i + 1 : outline.ring_start[ring];
      curves.outline.push_back({{outline.x[i], outline.y[i]}, {outline.x[next], outline.y[next]}});
      const std::uint32_t p = curves.outline_nodes[i], q = curves.outline_nodes[next];
      if (p != q) curves.segments.push_back({p, q, EdgeKind::outline, i});
    }
  }
}

/// Returns the length of what lies in the box.
double add_discontinuities(Curves& curves, Nodes& nodes, const BodyShape& body, const Lattice& lattice) {
  const Discontinuities& lines = body.discontinuities;
  if (lines.line_count == 0) return 0;
  const Box box = surroundings(body.outline, lattice);
  const std::uint32_t first_label = vertex_count(body.outline);
  double length = 0;
  for (std::uint32_t line = 0; line < lines.line_count; ++line) {
    for (std::uint32_t i = lines.line_start[line]; i < lines.line_start[line + 1]; ++i) {
      const std::uint32_t next = std::min(i + 1, lines.line_start[line + 1] - 1);
      const Point start{lines.x[i], lines.y[i]}, end{lines.x[next], lines.y[next]};
      curves.discontinuities.push_back({start, end});
      const LatticePoint p = lattice.place(start), q = lattice.place(end);
      double from, to;
      if (next == i || !clip(box, p, q, from, to)) continue;
      const auto node_at = [&](double share) {
        const LatticePoint at{p.a + share * (q.a - p.a), p.b + share * (q.b - p.b)};
        return nodes.near(to_grid(share == 1 ? q : at, nodes.tolerance()));
      };
      const std::uint32_t node = node_at(from), next_node = node_at(to);
      if (from == 0) curves.points.push_back({node, start});
      if (to == 1) curves.points.push_back({next_node, end});
      if (node != next_node) {
        curves.segments.push_back({node, next_node, EdgeKind::discontinuity, first_label + i});
      }
      length += (to - from) * distance(start, end);
    }
  }
  return length;
}

}  // namespace

double distance(Point p, Point q) {
  return std::hypot(q.x - p.x, q.y - p.y);
}

Curves make_curves(const BodyShape& body, const Lattice& lattice, Nodes& nodes) {
  const double around = outline_length(body.outline);
  check_count(body.moments.area, around, lattice.size());
  Curves curves;
  add_outline(curves, nodes, body.outline, lattice);
  const double cuts = add_discontinuities(curves, nodes, body, lattice);
  check_count(body.moments.area, around + cuts, lattice.size());
  return curves;
}

}  // namespace talus::hexagonal
