#include "model/region.hpp"

#include <algorithm>
#include <limits>

namespace talus {

std::array<double, 4> box_of(const std::vector<Ring>& region) {
  constexpr double far = std::numeric_limits<double>::infinity();
  std::array<double, 4> box{far, far, -far, -far};
  for (const Ring& ring : region) {
    for (const Vec2 p : ring)
      box = {std::min(box[0], p.x), std::min(box[1], p.y), std::max(box[2], p.x), std::max(box[3], p.y)};
  }
  return box;
}

double squared_distance(const std::array<double, 4>& box, Vec2 p) {
  const double dx = std::max({box[0] - p.x, 0.0, p.x - box[2]}),
               dy = std::max({box[1] - p.y, 0.0, p.y - box[3]});
  return dx * dx + dy * dy;
}

double squared_distance(const std::vector<Ring>& region, Vec2 p) {
  bool odd = false;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Ring& ring : region) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = ring[i], b = ring[i + 1 == ring.size() ? 0 : i + 1];
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) odd = !odd;
      const Vec2 side = b - a;
      const double length = side.x * side.x + side.y * side.y;
      const double along = length > 0 ? ((p.x - a.x) * side.x + (p.y - a.y) * side.y) / length : 0;
      const double place = std::clamp(along, 0.0, 1.0);
      const double dx = p.x - a.x - place * side.x, dy = p.y - a.y - place * side.y;
      nearest = std::min(nearest, dx * dx + dy * dy);
    }
  }
  return odd ? 0 : nearest;
}

}  // namespace talus
