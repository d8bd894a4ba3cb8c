#pragma once

#include "geometry/vec2.hpp"

#include <string>

namespace talus::verification {

/// A rectangle of triangles with alternating diagonals, as a text file of Gmsh (MSH 2.2). Its sides are the
/// groups "left", "right", "top" and "bottom".
struct RectangleMesh {
  Vec2 corner, size;  ///< m, lower left; width and height
  int columns = 1, rows = 1;
  double angle = 0;  ///< rad, turned about the corner, counter-clockwise

  std::string text() const;
};

}  // namespace talus::verification
