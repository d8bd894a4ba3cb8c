#include "simulation/numbering.hpp"

#include "geometry/box.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace talus {
namespace {

/// Fewer bodies stay in the cache however they are numbered.
constexpr std::size_t many = 2000;
/// Mean sizes of a body along the longer side that bodies listed one after the other may lie apart in the
/// mean.
constexpr double close = 10;

}  // namespace

Numbering numbering_of(const Scene& scene) {
  const std::size_t count = scene.bodies.size();
  if (count < many) return {};
  std::vector<Box> boxes;
  std::vector<Vec2> middles;
  for (const SceneBody& body : scene.bodies) {
    boxes.push_back(box_around(body.outer.vertices));
    const Box& box = boxes.back();
    middles.push_back((box.low + box.high) / 2);
  }
  const Box all = box_around(middles);
  const bool along_x = all.width() >= all.height();
  const auto place = [&](std::size_t body) { return along_x ? middles[body].x : middles[body].y; };
  double sizes = 0, apart = 0;
  for (std::size_t i = 0; i < count; ++i) {
    sizes += along_x ? boxes[i].width() : boxes[i].height();
    if (i > 0) apart += std::abs(place(i) - place(i - 1));
  }
  if (!(apart > close * sizes)) return {};
  Numbering numbering{std::vector<std::uint32_t>(count), std::vector<std::uint32_t>(count)};
  std::iota(numbering.outer.begin(), numbering.outer.end(), 0);
  std::stable_sort(numbering.outer.begin(), numbering.outer.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
  for (std::uint32_t i = 0; i < count; ++i) numbering.inner[numbering.outer[i]] = i;
  return numbering;
}

Scene renumbered(Scene scene, const Numbering& numbering) {
  if (numbering.outer.empty()) return scene;
  const auto reorder = [&](auto& of_bodies) {
    if (of_bodies.empty()) return;
    auto listed = std::move(of_bodies);
    of_bodies.clear();
    of_bodies.reserve(listed.size());
    for (const std::uint32_t body : numbering.outer) of_bodies.push_back(std::move(listed[body]));
  };
  const auto renumber = [&](auto& of_bodies) {
    for (auto& entry : of_bodies) entry.body = numbering.inside(entry.body);
  };
  const auto renumber_loads = [&](auto& settings) {
    renumber(settings.loads);
    renumber(settings.surface_loads);
    renumber(settings.prescribed);
    renumber(settings.absorbing);
  };
  reorder(scene.bodies);
  renumber_loads(scene);
  renumber(scene.monitors);
  for (Stage& stage : scene.stages) {
    renumber_loads(stage.settings);
    reorder(stage.settings.supports);
  }
  return scene;
}

}  // namespace talus
