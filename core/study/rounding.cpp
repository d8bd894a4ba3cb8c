#include "study/rounding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace talus {
namespace {

/// m, of all bodies together.
double extent_of(const Scene& scene) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Vec2 low{far, far}, high{-far, -far};
  for (const SceneBody& body : scene.bodies) {
    for (const Vec2& vertex : body.outer.vertices) {
      low = {std::min(low.x, vertex.x), std::min(low.y, vertex.y)};
      high = {std::max(high.x, vertex.x), std::max(high.y, vertex.y)};
    }
  }
  return scene.bodies.empty() ? 0 : std::max(high.x - low.x, high.y - low.y);
}

}  // namespace

double rounding_of(const Scene& scene, std::string_view column) {
  constexpr double share = 1e-12, radian = 180 / std::numbers::pi;
  if (column.ends_with(" [m]")) return share * extent_of(scene);
  if (column.ends_with(" [m/s]")) return share * extent_of(scene) / scene.time.end;
  if (column.ends_with(" [deg]")) return share * radian;
  if (column.ends_with(" [deg/s]")) return share * radian / scene.time.end;
  return 0;
}

}  // namespace talus
