// The triangles of a mesh file as elements: the finite element method as a cover. See README.md beside.

#include <talus/library.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace {

using namespace talus;

/// A side of a triangle that no other triangle shares.
struct FreeEdge {
  std::uint32_t from, to;  ///< nodes
  std::uint32_t triangle;
};

std::vector<FreeEdge> free_edges(const Triangulation& mesh) {
  std::vector<FreeEdge> all;
  for (std::uint32_t t = 0; t < mesh.triangle_count; ++t) {
    for (int k = 0; k < 3; ++k) all.push_back({mesh.corners[t][k], mesh.corners[t][(k + 1) % 3], t});
  }
  const auto ends = [](const FreeEdge& edge) {
    return std::pair(std::min(edge.from, edge.to), std::max(edge.from, edge.to));
  };
  std::stable_sort(all.begin(), all.end(),
                   [&](const FreeEdge& p, const FreeEdge& q) { return ends(p) < ends(q); });
  std::vector<FreeEdge> free;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool shared = (i > 0 && ends(all[i - 1]) == ends(all[i])) ||
                        (i + 1 < all.size() && ends(all[i + 1]) == ends(all[i]));
    if (!shared) free.push_back(all[i]);
  }
  return free;
}

/// Free edges by the place of their first node: the outline was made of the same numbers.
class EdgesByPlace {
 public:
  explicit EdgesByPlace(const Triangulation& mesh) : mesh_(mesh), edges_(free_edges(mesh)) {
    std::sort(edges_.begin(), edges_.end(),
              [&](const FreeEdge& p, const FreeEdge& q) { return place(p.from) < place(q.from); });
  }

  std::size_t size() const { return edges_.size(); }

  /// The free edge between two points, or nullptr.
  const FreeEdge* find(double from_x, double from_y, double to_x, double to_y) const {
    const std::pair from(from_x, from_y), to(to_x, to_y);
    const auto found =
        std::lower_bound(edges_.begin(), edges_.end(), from,
                         [&](const FreeEdge& edge, const auto& at) { return place(edge.from) < at; });
    if (found == edges_.end() || place(found->from) != from || place(found->to) != to) return nullptr;
    return &*found;
  }

 private:
  std::pair<double, double> place(std::uint32_t node) const { return {mesh_.x[node], mesh_.y[node]}; }

  const Triangulation& mesh_;
  std::vector<FreeEdge> edges_;
};

/// The free edge of each side of the outline; empty where the two differ.
std::vector<FreeEdge> follow(const Region& outline, const Triangulation& mesh) {
  const EdgesByPlace edges(mesh);
  std::vector<FreeEdge> sides;
  for (std::uint32_t ring = 0; ring < outline.ring_count; ++ring) {
    const std::uint32_t begin = outline.ring_start[ring], end = outline.ring_start[ring + 1];
    for (std::uint32_t i = begin; i < end; ++i) {
      const std::uint32_t next = i + 1 == end ? begin : i + 1;
      const FreeEdge* edge = edges.find(outline.x[i], outline.y[i], outline.x[next], outline.y[next]);
      if (edge == nullptr) return {};
      sides.push_back(*edge);
    }
  }
  return sides.size() == edges.size() ? sides : std::vector<FreeEdge>();
}

class Mesh final : public CoverBuilder {
 public:
  explicit Mesh(const double* /*values*/) {}

  void build(const BodyShape& body, CoverSink& sink) const noexcept override {
    const Triangulation& mesh = body.mesh;
    if (mesh.triangle_count == 0) {
      sink.refuse(
          "the body has no mesh: give \"mesh\": \"file.msh\" instead of \"polygon\", or take the cover "
          "\"hexagonal\"");
      return;
    }
    if (body.discontinuities.line_count > 0) {
      sink.refuse(
          "a mesh is not cut by discontinuities: cut it where it is made, or take the cover \"hexagonal\"");
      return;
    }
    const std::vector<FreeEdge> sides = follow(body.outline, mesh);
    if (sides.empty()) {
      sink.refuse("the outline of the body is not the boundary of its mesh");
      return;
    }
    for (std::uint32_t i = 0; i < mesh.node_count; ++i) sink.add_patch(mesh.x[i], mesh.y[i]);
    constexpr std::uint32_t ring[2] = {0, 3};
    for (std::uint32_t t = 0; t < mesh.triangle_count; ++t) {
      double x[3], y[3];
      for (int k = 0; k < 3; ++k) {
        x[k] = mesh.x[mesh.corners[t][k]];
        y[k] = mesh.y[mesh.corners[t][k]];
      }
      sink.add_element(mesh.corners[t], {x, y, ring, 1});
    }
    for (std::uint32_t loop = 0; loop < body.outline.ring_count; ++loop) {
      for (std::uint32_t i = body.outline.ring_start[loop]; i < body.outline.ring_start[loop + 1]; ++i) {
        sink.add_boundary_vertex(body.outline.x[i], body.outline.y[i], sides[i].triangle, i);
      }
      sink.close_boundary_loop();
    }
  }
};

constexpr Component components[] = {cover_builder<Mesh>(
    "mesh", "The triangles of the body's mesh as elements, its nodes as patches (finite elements).", {})};

}  // namespace

TALUS_EXPORT const talus::Library talus_library =
    talus::library("mesh", "0.1.0", "the talus authors", components);
