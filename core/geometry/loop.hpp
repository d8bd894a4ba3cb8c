#pragma once

#include "geometry/vec2.hpp"

#include <cstdint>
#include <vector>

namespace talus {

/// A closed part of the boundary of a body; edge i runs from vertex i.
struct Loop {
  std::vector<Vec2> vertices;                ///< m, relative to the scene's origin
  std::vector<std::uint32_t> surface_class;  ///< [edge] index into Scene::surfaces
};

}  // namespace talus
