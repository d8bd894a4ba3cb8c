#pragma once

#include "arrangement.hpp"

#include <cstdint>
#include <vector>

namespace talus::hexagonal {

inline constexpr std::uint32_t no_face = 0xFFFFFFFFu;

/// The planar graph by half-edges: 2e runs from node p of edge e to q, 2e + 1 back; a half-edge belongs to
/// the face on its left. Edges with a loose end are taken out, so that each edge has a face on either side.
struct Faces {
  Arrangement graph;
  std::vector<std::uint32_t> next;    ///< [half-edge] around its face
  std::vector<std::uint32_t> face;    ///< [half-edge], no_face beyond the rim of the lattice
  std::vector<std::uint32_t> degree;  ///< [node] edges of it that border on the body

  std::vector<std::uint32_t> cycle_start;  ///< [cycle] one half-edge of it; sorted by face
  std::vector<std::uint32_t> face_cycles;  ///< [face + 1] into cycle_start: outer cycle, then those of holes
  std::vector<Triangle> triangle;          ///< [face] the triangle of the lattice that it lies in
  std::vector<std::uint8_t> inside;        ///< [face] whether it is a part of the body

  std::uint32_t face_count() const { return static_cast<std::uint32_t>(triangle.size()); }
  const Edge& edge(std::uint32_t half_edge) const { return graph.edges[half_edge / 2]; }
  std::uint32_t origin(std::uint32_t half_edge) const {
    return half_edge % 2 == 0 ? edge(half_edge).p : edge(half_edge).q;
  }
  bool is_inside(std::uint32_t half_edge) const {
    return face[half_edge] != no_face && inside[face[half_edge]] == 1;
  }

  template <class Visit>
  void visit_cycle(std::uint32_t start, Visit&& visit) const {
    std::uint32_t half_edge = start;
    do {
      visit(half_edge);
      half_edge = next[half_edge];
    } while (half_edge != start);
  }

  /// Calls visit(half-edge) around all cycles of a face.
  template <class Visit>
  void visit_face(std::uint32_t which, Visit&& visit) const {
    for (std::uint32_t c = face_cycles[which]; c < face_cycles[which + 1]; ++c) {
      visit_cycle(cycle_start[c], visit);
    }
  }
};

Faces make_faces(Arrangement graph);

}  // namespace talus::hexagonal
