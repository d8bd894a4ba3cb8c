#pragma once

#include "geometry/outlines.hpp"

#include <string_view>

namespace talus::fuzz {

/// Polygons out of bytes, so that awkward ones are likely: corners on a coarse grid, within rounding of one,
/// on corners and sides of what came before, and anywhere.
class GivenPolygons {
 public:
  explicit GivenPolygons(std::string_view bytes) : bytes_(bytes) {}

  /// Counter-clockwise; of 3 to 10 corners. Where bytes run out they are zero.
  Ring next();

 private:
  int byte();
  Vec2 corner();
  double on_grid() { return byte() - 8; }
  double anywhere();

  std::string_view bytes_;
  Ring all_;  ///< corners so far
};

}  // namespace talus::fuzz
