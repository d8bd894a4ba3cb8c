#pragma once

#include "faces.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace talus::hexagonal {

inline constexpr std::uint32_t no_element = 0xFFFFFFFFu;

/// Physical patches and manifold elements (§2.2).
struct Connectivity {
  std::vector<LatticeVertex> patches;  ///< the vertex each stands on; several may stand on one (Eq. 8)

  struct Element {
    Triangle triangle;
    std::array<std::uint32_t, 3> patch;  ///< at the corners of the triangle, in their order
  };
  std::vector<Element> elements;
  std::vector<std::uint32_t> element_of;  ///< [face], no_element outside the body
  std::vector<std::uint32_t> faces;       ///< those of the body, element after element
  std::vector<std::uint32_t> first_face;  ///< [element + 1] into faces
};

/// Throws TooClose where the lattice has been bent out of shape.
Connectivity connect(const Faces& faces);

/// The element on the left of a half-edge, no_element outside the body.
std::uint32_t element_at(const Faces& faces, const Connectivity& connectivity, std::uint32_t half_edge);

/// Whether a half-edge is a side of the body's boundary: the body on its left, and on its right either
/// nothing or, across a discontinuity, an element whose displacement may differ along it.
bool on_boundary(const Faces& faces, const Connectivity& connectivity, std::uint32_t half_edge);

}  // namespace talus::hexagonal
