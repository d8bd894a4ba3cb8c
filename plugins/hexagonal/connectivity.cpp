#include "connectivity.hpp"

#include <algorithm>
#include <numeric>

namespace talus::hexagonal {
namespace {

/// Joins what each face holds of the mathematical patches at the corners of its triangle: slot 3·face +
/// corner.
class Slots {
 public:
  explicit Slots(std::uint32_t faces) : root_(3 * std::size_t{faces}) {
    std::iota(root_.begin(), root_.end(), 0u);
  }

  std::uint32_t find(std::uint32_t slot) {
    while (root_[slot] != slot) slot = root_[slot] = root_[root_[slot]];
    return slot;
  }

  void join(std::uint32_t p, std::uint32_t q) {
    p = find(p);
    q = find(q);
    root_[std::max(p, q)] = std::min(p, q);
  }

 private:
  std::vector<std::uint32_t> root_;
};

struct Sides {
  std::uint32_t lower, upper;  ///< half-edges, by the triangle on their left
};

Sides sides_of(const Edge& edge, std::uint32_t e) {
  const bool upper_left_of_even = edge.lattice.upper_on_left() != edge.against_lattice;
  return upper_left_of_even ? Sides{2 * e + 1, 2 * e} : Sides{2 * e, 2 * e + 1};
}

/// Two triangles share the patches of both ends of their common side, if any piece of it connects them.
Slots join_across_lattice(const Faces& faces) {
  Slots slots(faces.face_count());
  for (std::uint32_t e = 0; e < faces.graph.edges.size(); ++e) {
    const Edge& edge = faces.graph.edges[e];
    if (edge.kind != EdgeKind::lattice || !faces.is_inside(2 * e) || !faces.is_inside(2 * e + 1)) continue;
    const Sides sides = sides_of(edge, e);
    if (faces.triangle[faces.face[sides.lower]] != edge.lattice.lower() ||
        faces.triangle[faces.face[sides.upper]] != edge.lattice.upper()) {
      throw TooClose();  // a side that has been bent so often that it folds
    }
    const auto [start, end] = edge.lattice.corners_of_lower();
    slots.join(3 * faces.face[sides.lower] + start, 3 * faces.face[sides.upper] + end);
    slots.join(3 * faces.face[sides.lower] + end, 3 * faces.face[sides.upper] + start);
  }
  return slots;
}

using Roots = std::array<std::uint32_t, 3>;

}  // namespace

Connectivity connect(const Faces& faces) {
  Slots slots = join_across_lattice(faces);
  std::vector<Roots> roots(faces.face_count());
  Connectivity result;
  for (std::uint32_t f = 0; f < faces.face_count(); ++f) {
    if (faces.inside[f] == 0) continue;
    roots[f] = {slots.find(3 * f), slots.find(3 * f + 1), slots.find(3 * f + 2)};
    result.faces.push_back(f);
  }
  // Parts of a triangle with the same three patches move alike: one element.
  std::sort(result.faces.begin(), result.faces.end(), [&](std::uint32_t f, std::uint32_t g) {
    if (faces.triangle[f] != faces.triangle[g]) return faces.triangle[f] < faces.triangle[g];
    return roots[f] != roots[g] ? roots[f] < roots[g] : f < g;
  });

  constexpr std::uint32_t unnumbered = 0xFFFFFFFFu;
  std::vector<std::uint32_t> patch_of(3 * std::size_t{faces.face_count()}, unnumbered);
  result.element_of.assign(faces.face_count(), no_element);
  for (std::uint32_t k = 0; k < result.faces.size(); ++k) {
    const std::uint32_t f = result.faces[k];
    const std::uint32_t before = k > 0 ? result.faces[k - 1] : f;
    if (k == 0 || faces.triangle[before] != faces.triangle[f] || roots[before] != roots[f]) {
      Connectivity::Element element{faces.triangle[f], {}};
      for (std::size_t corner = 0; corner < 3; ++corner) {
        std::uint32_t& patch = patch_of[roots[f][corner]];
        if (patch == unnumbered) {
          patch = static_cast<std::uint32_t>(result.patches.size());
          result.patches.push_back(element.triangle.corners()[corner]);
        }
        element.patch[corner] = patch;
      }
      result.elements.push_back(element);
      result.first_face.push_back(k);
    }
    result.element_of[f] = static_cast<std::uint32_t>(result.elements.size() - 1);
  }
  result.first_face.push_back(static_cast<std::uint32_t>(result.faces.size()));
  return result;
}

std::uint32_t element_at(const Faces& faces, const Connectivity& connectivity, std::uint32_t half_edge) {
  const std::uint32_t face = faces.face[half_edge];
  return face == no_face ? no_element : connectivity.element_of[face];
}

bool on_boundary(const Faces& faces, const Connectivity& connectivity, std::uint32_t half_edge) {
  const std::uint32_t left = element_at(faces, connectivity, half_edge);
  const std::uint32_t right = element_at(faces, connectivity, half_edge ^ 1);
  if (left == no_element) return false;
  if (right == no_element) return true;
  const Edge& edge = faces.edge(half_edge);
  if (edge.kind == EdgeKind::lattice || left == right) return false;
  if (!edge.lattice) return true;
  // Along a side of the lattice only the patches of its two ends count.
  const Sides sides = sides_of(edge, half_edge / 2);
  const auto& lower = connectivity.elements[element_at(faces, connectivity, sides.lower)].patch;
  const auto& upper = connectivity.elements[element_at(faces, connectivity, sides.upper)].patch;
  const auto [start, end] = edge.lattice.corners_of_lower();
  return lower[start] != upper[end] || lower[end] != upper[start];
}

}  // namespace talus::hexagonal
