#pragma once

#include "scene/scene.hpp"

#include <cstdint>
#include <vector>

namespace talus {

/// How bodies are numbered within a simulation. Bodies that touch share lines of the cache where their
/// numbers are close; results do not show these numbers. Empty where bodies keep the numbers of the scene.
struct Numbering {
  std::vector<std::uint32_t> inner;  ///< [number in the scene]
  std::vector<std::uint32_t> outer;  ///< [number within]

  std::uint32_t inside(std::size_t body) const {
    return inner.empty() ? static_cast<std::uint32_t>(body) : inner[body];
  }
  std::uint32_t outside(std::uint32_t body) const { return outer.empty() ? body : outer[body]; }
};

/// Along the longer side of a scene of many bodies that lists them criss-cross. Rows, columns and curves that
/// fill the plane are good as they are.
Numbering numbering_of(const Scene& scene);

/// The scene as if it had listed its bodies in that order.
Scene renumbered(Scene scene, const Numbering& numbering);

}  // namespace talus
