#pragma once

#include "scene/polygons.hpp"
#include "scene/reading.hpp"

#include <string>
#include <vector>

namespace talus {

/// A body's shape as the scene gives it, made counter-clockwise outside and clockwise in holes.
struct Shape {
  Loops loops;
  std::vector<std::string> edge_surface;  ///< [edge of the outer loop] after turning; "" if unnamed
  bool sound = false;                     ///< whether it can be worked with
};

/// "polygon", "holes" and "surfaces" of a body.
Shape read_shape(Section& body);

}  // namespace talus
