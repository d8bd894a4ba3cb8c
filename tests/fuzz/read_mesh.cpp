#include "targets.hpp"

#include "files/input_error.hpp"
#include "geometry/gmsh.hpp"
#include "geometry/polygon.hpp"

#include <algorithm>
#include <cmath>

namespace talus::fuzz {

namespace {

/// Twice, and how large the terms are that make it up.
struct Area {
  double sum = 0, terms = 0;
  void add(Vec2 p, Vec2 q) {
    sum += cross(p, q);
    terms += std::abs(p.x * q.y) + std::abs(p.y * q.x);
  }
};

void check(const GmshMesh& mesh) {
  demand(!mesh.loops.empty() && !mesh.triangles.empty(), "a mesh without triangles or without a boundary");
  Area inside, around;
  for (const auto& corners : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      demand(corners[k] < mesh.nodes.size(), "a triangle without a corner");
      inside.add(mesh.nodes[corners[k]], mesh.nodes[corners[(k + 1) % 3]]);
    }
  }
  for (const GmshLoop& loop : mesh.loops) {
    demand(loop.surfaces.size() == loop.nodes.size(), "a side without a surface");
    for (std::size_t i = 0; i < loop.nodes.size(); ++i) {
      demand(loop.nodes[i] < mesh.nodes.size(), "a side without an end");
      around.add(mesh.nodes[loop.nodes[i]], mesh.nodes[loop.nodes[(i + 1) % loop.nodes.size()]]);
    }
  }
  if (!std::isfinite(inside.terms)) return;
  demand(std::abs(inside.sum - around.sum) <= 1e-12 * inside.terms, "the boundary encloses another area");
}

}  // namespace

/// The first line may name a physical group: "group NAME".
void read_mesh(std::string_view bytes) {
  constexpr std::string_view key = "group ";
  std::string group;
  if (bytes.starts_with(key)) {
    const std::size_t end = std::min(bytes.find('\n'), bytes.size());
    group = bytes.substr(key.size(), end - key.size());
    bytes.remove_prefix(end);
  }
  try {
    check(read_gmsh_text(bytes, "body.msh", group));
  } catch (const InputError&) {
  }
}

}  // namespace talus::fuzz
