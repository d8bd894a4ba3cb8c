#include "preview/preview.hpp"
#include "preview/values.hpp"
#include "scene/components.hpp"
#include "scene/surfaces.hpp"

#include <talus/material.hpp>

#include <cmath>
#include <set>
#include <span>
#include <string_view>

namespace talus {
namespace {

/// E of a body that deforms, if its material goes by that name.
std::optional<double> young_of(const Scene& scene, const SceneBody& body) {
  const Choice& model = scene.materials[body.material].model;
  if (body.fixed || model.component == nullptr ||
      std::string_view(body.cover.component->component->name) == rigid_cover)
    return std::nullopt;
  const Component& component = *model.component->component;
  const auto young = position_of({component.parameters, component.parameter_count}, "young_modulus");
  return young ? std::optional(model.values[*young]) : std::nullopt;
}

bool has_friction(const Component& law, const std::vector<double>& values) {
  const std::span<const Parameter> table{law.interface_parameters, law.interface_parameter_count};
  for (const char* key : {"friction_angle", "friction_coefficient"}) {
    if (const auto friction = position_of(table, key); friction && values[*friction] > 0) return true;
  }
  return false;
}

/// About half of the time that a wave takes across a body: it damps the modes that friction excites by half.
double stilling_time(const Scene& scene, const SceneBody& body, double young, double width) {
  const SceneMaterial& material = scene.materials[body.material];
  if (make<Material>(*material.model.component, material.model.values)->viscous_time() > 0) return 0;
  return width * std::sqrt(material.density / young) / 2;
}

std::set<std::uint32_t> classes_of_boundary(const SceneBody& body) {
  std::set<std::uint32_t> classes;
  each_loop(body,
            [&](const Loop& loop) { classes.insert(loop.surface_class.begin(), loop.surface_class.end()); });
  for (const Discontinuity& cut : body.discontinuities) classes.insert(cut.surface_class);
  return classes;
}

}  // namespace

void compare_stiffness(const Simulation& simulation, Preview& preview) {
  const Scene& scene = simulation.scene();
  if (scene.contact.component == nullptr) return;
  const Component& law = *scene.contact.component->component;
  const auto stiffness =
      position_of({law.interface_parameters, law.interface_parameter_count}, "normal_stiffness");
  if (!stiffness) return;
  const std::size_t count = scene.surfaces.size();
  const std::vector<bool> meet = meetings(scene);
  for (std::uint32_t body = 0; body < scene.bodies.size(); ++body) {
    const std::optional<double> young = young_of(scene, scene.bodies[body]);
    if (!young) continue;
    for (const std::uint32_t own : classes_of_boundary(scene.bodies[body])) {
      for (std::size_t other = 0; other < count; ++other) {
        if (!meet[own * count + other]) continue;
        const std::size_t row = scene.interface_row[own * count + other];
        const double width = simulation.body_width(body);
        const double stilling = has_friction(law, scene.interface_values[row])
                                    ? stilling_time(scene, scene.bodies[body], *young, width)
                                    : 0;
        const StiffnessShare share{row,    body,  scene.interface_values[row][*stiffness],
                                   *young, width, stilling};
        if (!preview.softest || share.share() < preview.softest->share()) preview.softest = share;
        const auto stiffer_than = [&](const std::optional<StiffnessShare>& former) {
          return !former || share.share() > former->share();
        };
        if (stiffer_than(preview.stiffest)) preview.stiffest = share;
        if (stilling > 0 && stiffer_than(preview.fluttering)) preview.fluttering = share;
      }
    }
  }
}

}  // namespace talus
