#pragma once

#include "geometry/vec2.hpp"

#include <algorithm>
#include <vector>

namespace talus {

/// An upright rectangle, m.
struct Box {
  Vec2 low, high;
  double width() const { return high.x - low.x; }
  double height() const { return high.y - low.y; }
  double size() const { return std::max(width(), height()); }
};

/// The smallest around points, one at least.
inline Box box_around(const std::vector<Vec2>& points) {
  Box box{points[0], points[0]};
  for (const Vec2 p : points) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  }
  return box;
}

}  // namespace talus
