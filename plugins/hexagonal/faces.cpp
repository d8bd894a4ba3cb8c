#include "faces.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <span>

namespace talus::hexagonal {
namespace {

/// Takes out edges with a loose end, again and again: what ends within a triangle does not cut it. The
/// lattice has no loose ends.
void remove_loose_ends(Arrangement& graph) {
  std::vector<std::uint32_t> degree(graph.grid.size(), 0), joined(graph.grid.size(), 0);
  for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
    for (const std::uint32_t node : {graph.edges[e].p, graph.edges[e].q}) {
      ++degree[node];
      joined[node] ^= e;  // of a node with one edge left, that edge
    }
  }
  std::vector<std::uint8_t> removed(graph.edges.size(), 0);
  for (std::uint32_t first = 0; first < degree.size(); ++first) {
    for (std::uint32_t node = first; degree[node] == 1;) {
      const std::uint32_t e = joined[node];
      const std::uint32_t other = graph.edges[e].p == node ? graph.edges[e].q : graph.edges[e].p;
      removed[e] = 1;
      degree[node] = 0;
      --degree[other];
      joined[other] ^= e;
      node = other;
    }
  }
  std::size_t count = 0;
  for (std::size_t e = 0; e < removed.size(); ++e) {
    if (removed[e] == 0) graph.edges[count++] = graph.edges[e];
  }
  graph.edges.resize(count);
}

/// By angle from the first direction of the lattice, counter-clockwise.
bool earlier(GridPoint origin, GridPoint p, GridPoint q) {
  const auto lower_half = [&](GridPoint at) {
    return at.b < origin.b || (at.b == origin.b && at.a < origin.a);
  };
  if (lower_half(p) != lower_half(q)) return lower_half(q);
  return cross(origin, p, q) > 0;
}

void join_half_edges(Faces& faces) {
  const auto half_edges = static_cast<std::uint32_t>(2 * faces.graph.edges.size());
  std::vector<std::uint32_t> first(faces.graph.grid.size() + 1, 0), outgoing(half_edges);
  for (std::uint32_t h = 0; h < half_edges; ++h) ++first[faces.origin(h) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::uint32_t> fill(first.begin(), first.end() - 1);
  for (std::uint32_t h = 0; h < half_edges; ++h) outgoing[fill[faces.origin(h)]++] = h;

  faces.next.resize(half_edges);
  const std::vector<GridPoint>& grid = faces.graph.grid;
  for (std::uint32_t node = 0; node < grid.size(); ++node) {
    const std::span<std::uint32_t> around(outgoing.data() + first[node], first[node + 1] - first[node]);
    std::sort(around.begin(), around.end(), [&](std::uint32_t g, std::uint32_t h) {
      return earlier(grid[node], grid[faces.origin(g ^ 1)], grid[faces.origin(h ^ 1)]);
    });
    // Who arrives against around[k] leaves by the one before it: the sharpest turn to the left.
    for (std::size_t k = 0; k < around.size(); ++k) {
      faces.next[around[k] ^ 1] = around[k > 0 ? k - 1 : around.size() - 1];
    }
  }
}

struct Cycle {
  std::uint32_t start;
  Wide area;        ///< twice, grid steps squared; negative: it runs around a hole or the whole
  bool on_lattice;  ///< whether it holds a side of the lattice
  std::uint32_t face = no_face;
};

std::vector<Cycle> find_cycles(const Faces& faces, std::vector<std::uint32_t>& cycle_of) {
  std::vector<Cycle> cycles;
  cycle_of.assign(faces.next.size(), no_face);
  for (std::uint32_t h = 0; h < faces.next.size(); ++h) {
    if (cycle_of[h] != no_face) continue;
    Cycle cycle{h, 0, false};
    const GridPoint origin = faces.graph.grid[faces.origin(h)];
    faces.visit_cycle(h, [&](std::uint32_t g) {
      cycle_of[g] = static_cast<std::uint32_t>(cycles.size());
      cycle.area += cross(origin, faces.graph.grid[faces.origin(g)], faces.graph.grid[faces.origin(g ^ 1)]);
      cycle.on_lattice = cycle.on_lattice || static_cast<bool>(faces.edge(g).lattice);
    });
    cycles.push_back(cycle);
  }
  return cycles;
}

/// From a side of the lattice, which is never in doubt, or from the node farthest from all lattice lines.
Triangle triangle_of(const Faces& faces, const Cycle& cycle) {
  std::optional<Triangle> by_side;
  GridPoint deepest{}, sum{0, 0};
  std::int64_t depth = -1, count = 0;
  const GridPoint origin = faces.graph.grid[faces.origin(cycle.start)];
  faces.visit_cycle(cycle.start, [&](std::uint32_t h) {
    const Edge& edge = faces.edge(h);
    if (edge.lattice && !by_side) {
      const bool along = (h % 2 == 0) != edge.against_lattice;
      by_side = along == edge.lattice.upper_on_left() ? edge.lattice.upper() : edge.lattice.lower();
    }
    const GridPoint at = faces.graph.grid[faces.origin(h)];
    if (distance_from_lines(at) > depth) {
      depth = distance_from_lines(at);
      deepest = at;
    }
    sum = {sum.a + at.a - origin.a, sum.b + at.b - origin.b};
    ++count;
  });
  if (by_side) return *by_side;
  if (depth > faces.graph.tolerance) return triangle_at(deepest);
  return triangle_at({origin.a + sum.a / count, origin.b + sum.b / count});
}

bool contains(const Faces& faces, const Cycle& cycle, GridPoint at) {
  bool inside = false;
  faces.visit_cycle(cycle.start, [&](std::uint32_t h) {
    GridPoint p = faces.graph.grid[faces.origin(h)], q = faces.graph.grid[faces.origin(h ^ 1)];
    if (p.b > q.b) std::swap(p, q);
    if (p.b <= at.b && at.b < q.b && cross(p, q, at) > 0) inside = !inside;
  });
  return inside;
}

/// Connected parts of the graph.
std::vector<std::uint32_t> parts(const Arrangement& graph) {
  std::vector<std::uint32_t> root(graph.grid.size());
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](std::uint32_t node) {
    while (root[node] != node) node = root[node] = root[root[node]];
    return node;
  };
  for (const Edge& edge : graph.edges) root[find(edge.p)] = find(edge.q);
  for (std::uint32_t node = 0; node < root.size(); ++node) root[node] = find(node);
  return root;
}

/// A part of the graph that lies within a triangle is a hole of the smallest face around it.
void place_holes(const Faces& faces, std::vector<Cycle>& cycles) {
  const auto is_hole = [](const Cycle& cycle) { return cycle.area < 0 && !cycle.on_lattice; };
  if (std::none_of(cycles.begin(), cycles.end(), is_hole)) return;
  const std::vector<std::uint32_t> part = parts(faces.graph);
  struct Candidate {
    Triangle triangle;
    std::uint32_t cycle;
  };
  std::vector<Candidate> candidates;
  for (std::uint32_t c = 0; c < cycles.size(); ++c) {
    if (cycles[c].area > 0) candidates.push_back({faces.triangle[cycles[c].face], c});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& m, const Candidate& n) { return m.triangle < n.triangle; });
  for (Cycle& hole : cycles) {
    if (!is_hole(hole)) continue;
    const std::uint32_t node = faces.origin(hole.start);
    const Triangle triangle = triangle_of(faces, hole);
    auto candidate = std::lower_bound(
        candidates.begin(), candidates.end(), triangle,
        [](const Candidate& entry, const Triangle& wanted) { return entry.triangle < wanted; });
    const Cycle* around = nullptr;
    for (; candidate != candidates.end() && candidate->triangle == triangle; ++candidate) {
      const Cycle& cycle = cycles[candidate->cycle];
      if (part[faces.origin(cycle.start)] == part[node]) continue;
      if (around != nullptr && around->area <= cycle.area) continue;
      if (contains(faces, cycle, faces.graph.grid[node])) around = &cycle;
    }
    if (around != nullptr) hole.face = around->face;
  }
}

void list_cycles(Faces& faces, const std::vector<Cycle>& cycles) {
  faces.face_cycles.assign(faces.face_count() + 1, 0);
  for (const Cycle& cycle : cycles) {
    if (cycle.face != no_face) ++faces.face_cycles[cycle.face + 1];
  }
  std::partial_sum(faces.face_cycles.begin(), faces.face_cycles.end(), faces.face_cycles.begin());
  std::vector<std::uint32_t> fill(faces.face_cycles.begin(), faces.face_cycles.end() - 1);
  faces.cycle_start.resize(faces.face_cycles.back());
  for (const bool outer : {true, false}) {
    for (const Cycle& cycle : cycles) {
      if (cycle.face != no_face && (cycle.area > 0) == outer) {
        faces.cycle_start[fill[cycle.face]++] = cycle.start;
      }
    }
  }
}

/// Beyond the rim the outline winds zero times around; each edge of it adds or takes one.
void find_inside(Faces& faces) {
  constexpr std::int32_t unknown = INT32_MIN;
  std::vector<std::int32_t> winding(faces.face_count(), unknown);
  std::vector<std::uint32_t> waiting;
  const auto pass = [&](std::uint32_t h, std::int32_t from) {
    const std::uint32_t beyond = faces.face[h ^ 1];
    if (beyond == no_face || winding[beyond] != unknown) return;
    winding[beyond] = h % 2 == 0 ? from - faces.edge(h).winding : from + faces.edge(h).winding;
    waiting.push_back(beyond);
  };
  for (std::uint32_t h = 0; h < faces.face.size(); ++h) {
    if (faces.face[h] == no_face) pass(h, 0);
  }
  while (!waiting.empty()) {
    const std::uint32_t face = waiting.back();
    waiting.pop_back();
    faces.visit_face(face, [&](std::uint32_t h) { pass(h, winding[face]); });
  }
  for (const std::int32_t turns : winding) faces.inside.push_back(turns > 0 ? 1 : 0);
}

void count_edges(Faces& faces) {
  faces.degree.assign(faces.graph.grid.size(), 0);
  for (std::uint32_t h = 0; h < faces.next.size(); ++h) {
    if (faces.is_inside(h) || faces.is_inside(h ^ 1)) ++faces.degree[faces.origin(h)];
  }
}

}  // namespace

Faces make_faces(Arrangement graph) {
  Faces faces;
  remove_loose_ends(graph);
  faces.graph = std::move(graph);
  join_half_edges(faces);
  std::vector<std::uint32_t> cycle_of;
  std::vector<Cycle> cycles = find_cycles(faces, cycle_of);
  for (Cycle& cycle : cycles) {
    if (cycle.area <= 0) continue;
    cycle.face = faces.face_count();
    faces.triangle.push_back(triangle_of(faces, cycle));
  }
  place_holes(faces, cycles);
  list_cycles(faces, cycles);
  faces.face.resize(cycle_of.size());
  for (std::size_t h = 0; h < cycle_of.size(); ++h) faces.face[h] = cycles[cycle_of[h]].face;
  find_inside(faces);
  count_edges(faces);
  return faces;
}

}  // namespace talus::hexagonal
