#pragma once

#include "geometry/outlines.hpp"
#include "scene/reading.hpp"

#include <string>
#include <vector>

namespace talus {

/// A body's shape as the scene gives it, made counter-clockwise outside and clockwise in holes.
struct Shape {
  Loops loops;
  std::vector<std::vector<std::string>> edge_surface;  ///< [loop][edge] after turning; "" if unnamed
  MeshTriangles mesh;                                  ///< none where the shape is a polygon
  bool sound = false;                                  ///< whether it can be worked with
};

/// "polygon", "holes" and "surfaces" of a body, or "mesh".
Shape read_shape(Reading& reading, Section& body);

/// "domain", "holes" and "surfaces" of a generator of blocks.
Shape read_domain(Section& generator);

}  // namespace talus
