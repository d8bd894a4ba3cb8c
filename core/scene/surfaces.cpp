#include "scene/surfaces.hpp"

#include <fmt/format.h>

#include <map>
#include <tuple>

namespace talus {
namespace {

/// A few bodies stand for all that have a class: two of each kind suffice to find two different ones.
struct Holders {
  std::vector<std::size_t> moving, fixed;

  void add(std::size_t body, bool is_fixed) {
    std::vector<std::size_t>& same = is_fixed ? fixed : moving;
    if (same.size() < 2 && (same.empty() || same.back() != body)) same.push_back(body);
  }
};

bool differ(const std::vector<std::size_t>& a, const std::vector<std::size_t>& b) {
  for (const std::size_t i : a) {
    for (const std::size_t j : b) {
      if (i != j) return true;
    }
  }
  return false;
}

void check_surface_names(Reading& reading) {
  for (std::size_t body = 0; body < reading.edge_surface.size(); ++body) {
    const std::set<std::string> names(reading.edge_surface[body].begin(), reading.edge_surface[body].end());
    for (const std::string& name : names) {
      if (!reading.material_index.contains(name)) continue;
      reading.mistakes.add_at_key(
          below(below(below("/bodies", body), "surfaces"), name),
          fmt::format("\"{}\" is the name of a material: interfaces could not tell the two "
                      "apart, rename one",
                      name));
    }
  }
}

}  // namespace

std::vector<NumberedSurface> number_surfaces(Reading& reading, const std::set<std::string>& single) {
  check_surface_names(reading);
  std::vector<NumberedSurface> surfaces;
  if (reading.scene.materials.empty()) return surfaces;
  std::map<std::tuple<std::uint32_t, std::string, std::string>, std::uint32_t> number;
  const auto number_of = [&](const SceneBody& body, const std::string& surface) {
    const bool alone = !surface.empty() && single.contains(body.name + '/' + surface);
    const auto key = std::tuple(body.material, surface, alone ? body.name : std::string());
    const auto [found, is_new] = number.emplace(key, static_cast<std::uint32_t>(surfaces.size()));
    if (is_new) {
      const std::string& material = reading.scene.materials[body.material].name;
      surfaces.push_back({material, surface, alone ? body.name : std::string()});
      reading.scene.surfaces.push_back({material, surface});
    }
    return found->second;
  };
  for (std::size_t i = 0; i < reading.scene.bodies.size(); ++i) {
    SceneBody& body = reading.scene.bodies[i];
    for (const std::string& name : reading.edge_surface[i])
      body.outer.surface_class.push_back(number_of(body, name));
    for (Loop& hole : body.holes) hole.surface_class.assign(hole.vertices.size(), number_of(body, ""));
  }
  return surfaces;
}

std::vector<bool> meetings(const Scene& scene) {
  const std::size_t count = scene.surfaces.size();
  std::vector<Holders> holders(count);
  for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
    const bool fixed = scene.bodies[body].fixed;
    for (const std::uint32_t surface : scene.bodies[body].outer.surface_class)
      holders[surface].add(body, fixed);
    for (const Loop& hole : scene.bodies[body].holes) {
      for (const std::uint32_t surface : hole.surface_class) holders[surface].add(body, fixed);
    }
  }
  std::vector<bool> meet(count * count);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < count; ++j) {
      const Holders &a = holders[i], &b = holders[j];
      meet[i * count + j] =
          differ(a.moving, b.moving) || differ(a.moving, b.fixed) || differ(a.fixed, b.moving);
    }
  }
  return meet;
}

}  // namespace talus
