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

/// Where a body says that it has the surface.
std::string pointer_to_surface(const Reading& reading, std::size_t body, const std::string& name) {
  const std::string pointer = below("/bodies", body);
  const SurfaceNames& names = reading.surface_names[body];
  for (std::size_t i = 0; i < names.discontinuities.size(); ++i) {
    if (names.discontinuities[i] == name)
      return below(below(below(pointer, "discontinuities"), i), "surface");
  }
  const bool meshed = !reading.scene.bodies[body].mesh.corners.empty();
  return meshed ? below(pointer, "mesh") : below(below(pointer, "surfaces"), name);
}

void check_surface_names(Reading& reading) {
  for (std::size_t body = 0; body < reading.surface_names.size(); ++body) {
    for (const std::string& name : reading.surface_names[body].all()) {
      if (!reading.material_index.contains(name)) continue;
      reading.mistakes.add_at_key(
          pointer_to_surface(reading, body, name),
          fmt::format("\"{}\" is the name of a material: interfaces could not tell the two "
                      "apart, rename one",
                      name));
    }
  }
}

/// Classes of a body's boundary and those of its cuts alone.
struct ClassesOfBody {
  std::set<std::uint32_t> all, cuts;
};

ClassesOfBody classes_of(const SceneBody& body) {
  ClassesOfBody classes;
  each_loop(body, [&](const Loop& loop) {
    classes.all.insert(loop.surface_class.begin(), loop.surface_class.end());
  });
  for (const Discontinuity& cut : body.discontinuities) classes.cuts.insert(cut.surface_class);
  classes.all.insert(classes.cuts.begin(), classes.cuts.end());
  return classes;
}

}  // namespace

std::vector<NumberedSurface> number_surfaces(Reading& reading, const std::set<std::string>& single) {
  check_surface_names(reading);
  std::vector<NumberedSurface> surfaces;
  reading.surface_class.resize(reading.scene.bodies.size());
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
    const SurfaceNames& names = reading.surface_names[i];
    std::map<std::string, std::uint32_t>& named = reading.surface_class[i];
    const auto class_of = [&](const std::string& name) {
      const std::uint32_t number_of_class = number_of(body, name);
      if (!name.empty()) named[name] = number_of_class;
      return number_of_class;
    };
    for (const std::string& name : names.edges[0]) body.outer.surface_class.push_back(class_of(name));
    for (std::size_t hole = 0; hole < body.holes.size(); ++hole) {
      for (const std::string& name : names.edges[hole + 1])
        body.holes[hole].surface_class.push_back(class_of(name));
    }
    for (std::size_t cut = 0; cut < body.discontinuities.size(); ++cut)
      body.discontinuities[cut].surface_class = class_of(names.discontinuities[cut]);
  }
  return surfaces;
}

std::vector<bool> meetings(const Scene& scene, bool apart) {
  const std::size_t count = scene.surfaces.size();
  std::vector<Holders> holders(count);
  std::vector<bool> meet(count * count);
  if (count == 0) return meet;  // there is no material, which was told
  for (std::size_t number = 0; number < scene.bodies.size(); ++number) {
    const SceneBody& body = scene.bodies[number];
    const ClassesOfBody classes = classes_of(body);
    for (const std::uint32_t surface : classes.all) holders[surface].add(number, body.fixed);
    if (body.fixed) continue;
    const bool all = body.self_contact || (apart && !body.discontinuities.empty());
    for (const std::uint32_t a : all ? classes.all : classes.cuts) {
      for (const std::uint32_t b : classes.all) meet[a * count + b] = meet[b * count + a] = true;
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < count; ++j) {
      const Holders &a = holders[i], &b = holders[j];
      if (differ(a.moving, b.moving) || differ(a.moving, b.fixed) || differ(a.fixed, b.moving))
        meet[i * count + j] = true;
    }
  }
  return meet;
}

}  // namespace talus
