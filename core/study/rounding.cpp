#include "study/rounding.hpp"

#include "geometry/box.hpp"

#include <numbers>
#include <vector>

namespace talus {
namespace {

/// m, of all bodies together.
double extent_of(const Scene& scene) {
  std::vector<Vec2> vertices;
  for (const SceneBody& body : scene.bodies)
    vertices.insert(vertices.end(), body.outer.vertices.begin(), body.outer.vertices.end());
  return vertices.empty() ? 0 : box_around(vertices).size();
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
