#include "geometry/gmsh.hpp"

#include "files/input_error.hpp"
#include "files/whole_file.hpp"
#include "geometry/gmsh_file.hpp"
#include "geometry/polygon.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace talus {
namespace {

constexpr std::uint32_t none = 0xFFFFFFFFu;

/// A side of a triangle, with the triangle on its left.
struct Edge {
  std::uint32_t from, to;
  std::uint32_t triangle;

  std::pair<std::uint32_t, std::uint32_t> ends() const { return std::minmax(from, to); }
};

class Builder {
 public:
  Builder(const GmshFile& file, const std::string& group) : file_(file) {
    choose_triangles(group);
    take_nodes();
    check_nodes();
    turn_triangles();
    pair_edges();
    check_one_part();
    trace_loops();
    name_sides();
  }

  GmshMesh take() { return std::move(mesh_); }

 private:
  [[noreturn]] void fail(const std::string& words) const {
    throw InputError(fmt::format("{}: {}", file_.name, words));
  }
  [[noreturn]] void fail(std::size_t line, const std::string& words) const {
    throw InputError(fmt::format("{}:{}: {}", file_.name, line, words));
  }

  const std::vector<std::string>& groups_of(int dimension, std::int64_t key) {
    const auto [entry, is_new] = groups_.try_emplace({dimension, key});
    if (is_new) entry->second = file_.groups_of(dimension, key);
    return entry->second;
  }

  /// Of the group; a triangle that is written once for each of its groups counts once.
  void choose_triangles(const std::string& group) {
    std::vector<std::pair<std::array<std::uint64_t, 3>, const GmshFile::Cell*>> chosen;
    for (const GmshFile::Cell& cell : file_.triangles) {
      const std::vector<std::string>& groups = groups_of(2, cell.key);
      if (!group.empty() && !std::binary_search(groups.begin(), groups.end(), group)) continue;
      std::array<std::uint64_t, 3> corners = cell.nodes;
      std::sort(corners.begin(), corners.end());
      if (corners[0] == corners[1] || corners[1] == corners[2]) {
        fail(cell.line, "a triangle has a corner twice");
      }
      chosen.emplace_back(corners, &cell);
    }
    if (chosen.empty() && !group.empty() && !file_.triangles.empty()) fail_without(group);
    if (chosen.empty())
      fail("there are no triangles; save all elements, or the physical groups of the surface");
    std::stable_sort(chosen.begin(), chosen.end(),
                     [](const auto& p, const auto& q) { return p.first < q.first; });
    const auto same = [](const auto& p, const auto& q) { return p.first == q.first; };
    chosen.erase(std::unique(chosen.begin(), chosen.end(), same), chosen.end());
    for (const auto& [corners, cell] : chosen) cells_.push_back(cell);
    std::sort(cells_.begin(), cells_.end(), [](const auto* p, const auto* q) { return p->line < q->line; });
    if (cells_.size() >= none / 3) fail("there are more triangles than can be numbered");
  }

  [[noreturn]] void fail_without(const std::string& group) const {
    std::set<std::string> all;
    for (const auto& [key, names] : groups_) all.insert(names.begin(), names.end());
    fail(fmt::format("no triangle is in the physical group \"{}\"; there are: {}", group,
                     all.empty() ? "none" : fmt::format("{}", fmt::join(all, ", "))));
  }

  /// Those in use, in the order of the file.
  void take_nodes() {
    by_tag_.resize(file_.nodes.size());
    for (std::size_t i = 0; i < by_tag_.size(); ++i) by_tag_[i] = {file_.nodes[i].tag, i};
    std::sort(by_tag_.begin(), by_tag_.end());
    for (std::size_t i = 1; i < by_tag_.size(); ++i) {
      if (by_tag_[i].first != by_tag_[i - 1].first) continue;
      fail(file_.nodes[by_tag_[i].second].line, fmt::format("node {} is there twice", by_tag_[i].first));
    }
    std::vector<std::uint8_t> used(file_.nodes.size());
    for (const GmshFile::Cell* cell : cells_) {
      for (const std::uint64_t tag : cell->nodes) {
        const std::size_t at = position_of(tag);
        if (at == file_.nodes.size()) fail(cell->line, fmt::format("there is no node {}", tag));
        used[at] = 1;
      }
    }
    number_of_.assign(file_.nodes.size(), none);
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (used[i] == 0) continue;
      number_of_[i] = static_cast<std::uint32_t>(taken_.size());
      taken_.push_back(&file_.nodes[i]);
      mesh_.nodes.push_back({file_.nodes[i].x, file_.nodes[i].y});
    }
    for (const GmshFile::Cell* cell : cells_) {
      std::array<std::uint32_t, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) corners[k] = number_of_[position_of(cell->nodes[k])];
      mesh_.triangles.push_back(corners);
    }
  }

  /// Index into the nodes of the file, or their number.
  std::size_t position_of(std::uint64_t tag) const {
    const auto found = std::lower_bound(by_tag_.begin(), by_tag_.end(), std::pair{tag, std::size_t{0}});
    return found == by_tag_.end() || found->first != tag ? by_tag_.size() : found->second;
  }

  void check_nodes() const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double low[2] = {infinity, infinity}, high[2] = {-infinity, -infinity};
    for (const Vec2 p : mesh_.nodes) {
      low[0] = std::min(low[0], p.x), high[0] = std::max(high[0], p.x);
      low[1] = std::min(low[1], p.y), high[1] = std::max(high[1], p.y);
    }
    const double size = std::max(high[0] - low[0], high[1] - low[1]);
    if (!std::isfinite(size)) fail("the mesh is too large for the computer's numbers");
    for (const GmshFile::Node* node : taken_) {
      if (!(std::abs(node->z - taken_[0]->z) <= 1e-9 * size)) {
        fail(node->line,
             fmt::format("node {} is at z = {}, node {} at z = {}: the mesh must lie in the x-y plane",
                         node->tag, node->z, taken_[0]->tag, taken_[0]->z));
      }
    }
    std::vector<const GmshFile::Node*> sorted = taken_;
    std::sort(sorted.begin(), sorted.end(), [](const auto* p, const auto* q) {
      return std::tuple(p->x, p->y, p->line) < std::tuple(q->x, q->y, q->line);
    });
    for (std::size_t i = 1; i < sorted.size(); ++i) {
      if (sorted[i]->x != sorted[i - 1]->x || sorted[i]->y != sorted[i - 1]->y) continue;
      fail(sorted[i]->line,
           fmt::format("nodes {} and {} are at the same place; merge them (\"Coherence Mesh\")",
                       sorted[i - 1]->tag, sorted[i]->tag));
    }
  }

  void turn_triangles() {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      std::array<std::uint32_t, 3>& corners = mesh_.triangles[t];
      const Vec2 a = mesh_.nodes[corners[0]], b = mesh_.nodes[corners[1]], c = mesh_.nodes[corners[2]];
      const Vec2 p = b - a, q = c - a;
      const double twice_area = p.x * q.y - p.y * q.x;
      const double square = std::max({p.x * p.x + p.y * p.y, q.x * q.x + q.y * q.y,
                                      (q.x - p.x) * (q.x - p.x) + (q.y - p.y) * (q.y - p.y)});
      if (!(std::abs(twice_area) > 1e-12 * square)) fail(cells_[t]->line, "a triangle has no area");
      if (twice_area < 0) std::swap(corners[1], corners[2]);
    }
  }

  std::uint64_t tag_of(std::uint32_t node) const { return taken_[node]->tag; }

  /// Two triangles meet at an edge, or one is at the boundary.
  void pair_edges() {
    std::vector<Edge> edges;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        edges.push_back(
            {mesh_.triangles[t][k], mesh_.triangles[t][(k + 1) % 3], static_cast<std::uint32_t>(t)});
      }
    }
    std::stable_sort(edges.begin(), edges.end(),
                     [](const Edge& p, const Edge& q) { return p.ends() < q.ends(); });
    for (std::size_t i = 0; i < edges.size();) {
      std::size_t end = i + 1;
      while (end < edges.size() && edges[end].ends() == edges[i].ends()) ++end;
      const auto [low, high] = edges[i].ends();
      if (end - i > 2) {
        fail(cells_[edges[i + 2].triangle]->line,
             fmt::format("more than two triangles meet at the edge from node {} to node {}", tag_of(low),
                         tag_of(high)));
      }
      if (end - i == 2 && edges[i].from == edges[i + 1].from) {
        fail(cells_[edges[i + 1].triangle]->line,
             fmt::format("two triangles overlap at the edge from node {} to node {}", tag_of(low),
                         tag_of(high)));
      }
      if (end - i == 1) free_.push_back(edges[i]);
      i = end;
    }
  }

  /// Parts that touch at a node alone are told apart when the boundary is traced.
  void check_one_part() const {
    std::vector<std::uint32_t> parent(mesh_.nodes.size());
    for (std::uint32_t i = 0; i < parent.size(); ++i) parent[i] = i;
    const auto root = [&](std::uint32_t node) {
      while (parent[node] != node) node = parent[node] = parent[parent[node]];
      return node;
    };
    std::size_t parts = parent.size();
    for (const auto& corners : mesh_.triangles) {
      for (const std::size_t k : {1, 2}) {
        const std::uint32_t p = root(corners[0]), q = root(corners[k]);
        if (p != q) --parts;
        parent[std::max(p, q)] = std::min(p, q);
      }
    }
    if (parts == 1) return;
    std::uint32_t other = 0;
    while (root(other) == root(0)) ++other;
    fail(fmt::format(
        "the mesh has {} parts that do not touch (nodes {} and {} are in two of them); a body is one "
        "part: give each its physical group and a body of its own",
        parts, tag_of(0), tag_of(other)));
  }

  void trace_loops() {
    std::vector<std::uint32_t> next(mesh_.nodes.size(), none);
    for (const Edge& edge : free_) {
      if (next[edge.from] != none) {
        fail(taken_[edge.from]->line,
             fmt::format("the boundary comes to node {} twice: there the mesh touches itself at a point",
                         tag_of(edge.from)));
      }
      next[edge.from] = edge.to;
    }
    std::size_t outer = 0;
    for (std::uint32_t start = 0; start < next.size(); ++start) {
      GmshLoop loop;
      std::vector<Vec2> ring;
      for (std::uint32_t node = start; next[node] != none;) {
        loop.nodes.push_back(node);
        ring.push_back(mesh_.nodes[node]);
        node = std::exchange(next[node], none);
      }
      if (loop.nodes.empty()) continue;
      if (ring_moments(ring, ring[0]).area < 0) {
        mesh_.loops.push_back(std::move(loop));
      } else {
        ++outer;
        mesh_.loops.insert(mesh_.loops.begin(), std::move(loop));
      }
    }
    if (outer != 1) fail(fmt::format("the mesh has {} outer boundaries: it overlaps itself", outer));
  }

  void name_sides() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> names;
    for (const Edge& edge : free_) names[edge.ends()];
    for (const GmshFile::Cell& line : file_.lines) {
      std::array<std::uint32_t, 2> ends;
      for (std::size_t k = 0; k < 2; ++k) {
        const std::size_t at = position_of(line.nodes[k]);
        if (at == file_.nodes.size()) fail(line.line, fmt::format("there is no node {}", line.nodes[k]));
        ends[k] = number_of_[at];
      }
      const auto side = names.find(std::minmax(ends[0], ends[1]));
      if (side == names.end()) continue;  // within the mesh, or of another part
      for (const std::string& name : groups_of(1, line.key)) {
        if (!side->second.empty() && side->second != name) {
          fail(line.line,
               fmt::format("a side is in the physical groups \"{}\" and \"{}\": a side has one surface",
                           side->second, name));
        }
        side->second = name;
      }
    }
    for (GmshLoop& loop : mesh_.loops) {
      for (std::size_t i = 0; i < loop.nodes.size(); ++i) {
        const std::uint32_t from = loop.nodes[i], to = loop.nodes[i + 1 == loop.nodes.size() ? 0 : i + 1];
        loop.surfaces.push_back(names[std::minmax(from, to)]);
      }
    }
  }

  const GmshFile& file_;
  std::map<GmshFile::Tag, std::vector<std::string>> groups_;
  std::vector<const GmshFile::Cell*> cells_;                   ///< [triangle]
  std::vector<std::pair<std::uint64_t, std::size_t>> by_tag_;  ///< sorted: tag, index into the file's nodes
  std::vector<std::uint32_t> number_of_;                       ///< [node of the file] in the mesh, or none
  std::vector<const GmshFile::Node*> taken_;                   ///< [node]
  std::vector<Edge> free_;
  GmshMesh mesh_;
};

}  // namespace

GmshMesh read_gmsh(const std::filesystem::path& file, const std::string& group) {
  return read_gmsh_text(read_whole_file(file), file.string(), group);
}

GmshMesh read_gmsh_text(std::string_view text, const std::string& name, const std::string& group) {
  const GmshFile file = parse_gmsh(text, name);
  return Builder(file, group).take();
}

}  // namespace talus
