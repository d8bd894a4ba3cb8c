#include "arrangement.hpp"

#include "cells.hpp"
#include "curves.hpp"

#include <algorithm>
#include <tuple>

namespace talus::hexagonal {
namespace {

NeededCells cells_of(const Curves& curves, const Nodes& nodes) {
  std::vector<Cell> touched;
  std::vector<OutlinePiece> outline;
  for (const Segment& segment : curves.segments) {
    visit_cells(nodes[segment.p], nodes[segment.q], [&](Cell cell) { touched.push_back(cell); });
    if (segment.kind == EdgeKind::outline) outline.push_back({nodes[segment.p], nodes[segment.q]});
  }
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  return needed_cells(touched, outline);
}

Segment lattice_segment(Nodes& nodes, const LatticeSide& side) {
  return {nodes.vertex(side.start()), nodes.vertex(side.end()), EdgeKind::lattice, 0, side};
}

Edge edge_of(const Segment& segment) {
  const bool turned = segment.p > segment.q;
  const std::int32_t winding = segment.kind != EdgeKind::outline ? 0 : turned ? -1 : 1;
  return {std::min(segment.p, segment.q),
          std::max(segment.p, segment.q),
          segment.kind,
          segment.label,
          segment.lattice,
          turned,
          winding};
}

/// One edge for all segments between the same two nodes.
std::vector<Edge> merged(const std::vector<Segment>& segments) {
  std::vector<Edge> edges;
  edges.reserve(segments.size());
  for (const Segment& segment : segments) edges.push_back(edge_of(segment));
  std::sort(edges.begin(), edges.end(), [](const Edge& m, const Edge& n) {
    return std::tie(m.p, m.q, m.kind, m.label) < std::tie(n.p, n.q, n.kind, n.label);
  });
  std::size_t count = 0;
  for (const Edge& edge : edges) {
    if (count == 0 || edges[count - 1].p != edge.p || edges[count - 1].q != edge.q) {
      edges[count++] = edge;
      continue;
    }
    Edge& kept = edges[count - 1];
    kept.winding += edge.winding;
    if (edge.lattice) {
      kept.lattice = edge.lattice;
      kept.against_lattice = edge.against_lattice;
    }
  }
  edges.resize(count);
  return edges;
}

Point foot(const Curves::Side& side, Point p) {
  const double along_x = side.end.x - side.start.x, along_y = side.end.y - side.start.y;
  const double share = ((p.x - side.start.x) * along_x + (p.y - side.start.y) * along_y) /
                       (along_x * along_x + along_y * along_y);
  return {side.start.x + share * along_x, side.start.y + share * along_y};
}

/// Where a side crosses another near p, or nothing near p.
Point meeting(const Curves::Side& side, const Curves::Side& other, Point p) {
  const double x = side.end.x - side.start.x, y = side.end.y - side.start.y;
  const double other_x = other.end.x - other.start.x, other_y = other.end.y - other.start.y;
  const Point on = foot(side, p);
  const double distance_over_sine =
      ((other.start.x - on.x) * other_y - (other.start.y - on.y) * other_x) / (x * other_y - y * other_x);
  return {on.x + distance_over_sine * x, on.y + distance_over_sine * y};
}

/// The curve that a node lies on, if any, and another line that crosses it there, if any.
struct LinesOfNode {
  const Edge* first = nullptr;
  const Edge* second = nullptr;
};

std::vector<LinesOfNode> lines_of_nodes(const Arrangement& made) {
  std::vector<LinesOfNode> lines(made.grid.size());
  for (const EdgeKind kind : {EdgeKind::outline, EdgeKind::discontinuity, EdgeKind::lattice}) {
    for (const Edge& edge : made.edges) {
      if (edge.kind != kind) continue;
      for (const std::uint32_t node : {edge.p, edge.q}) {
        auto& [first, second] = lines[node];
        if (first == nullptr) {
          if (kind != EdgeKind::lattice) first = &edge;
        } else if (second == nullptr && (edge.kind != first->kind || edge.label != first->label)) {
          second = &edge;
        }
      }
    }
  }
  return lines;
}

/// The grid decides what meets; where exactly follows from the lines as they were drawn. The outline keeps
/// its shape to the last digit.
std::vector<Point> positions(const Arrangement& made, const Curves& curves, const Region& outline,
                             const Lattice& lattice) {
  std::vector<Point> point;
  point.reserve(made.grid.size());
  for (const GridPoint& at : made.grid) point.push_back(lattice.point(at));
  const auto drawn = [&](const Edge& edge) -> Curves::Side {
    if (edge.kind == EdgeKind::outline) return curves.outline[edge.label];
    if (edge.kind == EdgeKind::discontinuity)
      return curves.discontinuities[edge.label - vertex_count(outline)];
    return {lattice.point(edge.lattice.start()), lattice.point(edge.lattice.end())};
  };
  const std::vector<LinesOfNode> lines = lines_of_nodes(made);
  // A flat crossing lies several grid steps from where rounding put it.
  const double near = 32 * lattice.size() / static_cast<double>(unit);
  for (std::uint32_t node = 0; node < lines.size(); ++node) {
    const auto [first, second] = lines[node];
    if (first == nullptr) continue;
    const Point on = foot(drawn(*first), point[node]);
    const Point at = second == nullptr ? on : meeting(drawn(*first), drawn(*second), point[node]);
    point[node] = distance(on, at) <= near ? at : on;
  }
  for (const auto& [node, at] : curves.points) {
    if (lines[node].first != nullptr && lines[node].first->kind != EdgeKind::outline) point[node] = at;
  }
  for (std::uint32_t i = vertex_count(outline); i-- > 0;) {
    point[curves.outline_nodes[i]] = {outline.x[i], outline.y[i]};
  }
  return point;
}

}  // namespace

Arrangement arrange(const BodyShape& body, const Lattice& lattice, std::int64_t tolerance) {
  Nodes nodes(tolerance);
  const Curves curves = make_curves(body, lattice, nodes);
  const LatticeSides sides = lattice_sides(cells_of(curves, nodes));
  std::vector<Segment> segments = curves.segments;
  for (const LatticeSide& side : sides.near_curves) segments.push_back(lattice_segment(nodes, side));
  node_segments(nodes, segments);

  Arrangement result{tolerance, {}, {}, {}};
  result.edges = merged(segments);
  result.edges.reserve(result.edges.size() + sides.clear.size());
  for (const LatticeSide& side : sides.clear) result.edges.push_back(edge_of(lattice_segment(nodes, side)));
  result.grid.reserve(nodes.size());
  for (std::uint32_t node = 0; node < nodes.size(); ++node) result.grid.push_back(nodes[node]);
  result.point = positions(result, curves, body.outline, lattice);
  return result;
}

bool is_in_order(const Arrangement& made, const Lattice& lattice) {
  return std::all_of(made.edges.begin(), made.edges.end(), [&](const Edge& edge) {
    if (edge.kind == EdgeKind::lattice) return true;
    const Point p = lattice.point(made.grid[edge.p]), q = lattice.point(made.grid[edge.q]);
    const Point from = made.point[edge.p], to = made.point[edge.q];
    const double along = (q.x - p.x) * (to.x - from.x) + (q.y - p.y) * (to.y - from.y);
    const double squared = (q.x - p.x) * (q.x - p.x) + (q.y - p.y) * (q.y - p.y);
    return along > squared / 4;
  });
}

}  // namespace talus::hexagonal
