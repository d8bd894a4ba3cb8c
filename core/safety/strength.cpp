#include "safety/strength.hpp"

#include "files/input_error.hpp"
#include "plugin/parameters.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

namespace talus {
namespace {

/// Divides what of these values is strength; returns whether any is.
bool reduce(std::span<const Parameter> parameters, double factor, std::vector<double>& values) {
  bool reduced = false;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const std::string_view key = parameters[i].key;
    if (key.ends_with("friction_angle")) {
      reduced = reduced || values[i] > 0;
      values[i] = std::atan(std::tan(values[i]) / factor);
    } else if (key.ends_with("friction_coefficient") || key.ends_with("cohesion") ||
               key.ends_with("tensile_strength")) {
      reduced = reduced || values[i] > 0;
      values[i] /= factor;
    }
  }
  // Rock that has less friction dilates no more than that allows.
  const auto friction = index_of(parameters, "friction_angle"),
             dilation = index_of(parameters, "dilation_angle");
  if (friction && dilation) values[*dilation] = std::min(values[*dilation], values[*friction]);
  return reduced;
}

}  // namespace

bool reduce(Choice& model, double factor) {
  return model.component != nullptr &&
         reduce({model.component->component->parameters, model.component->component->parameter_count}, factor,
                model.values);
}

Scene with_reduced_strength(const Scene& scene, double factor) {
  Scene reduced = scene;
  reduced.stages.clear();
  // What creeps against damping has no acceleration to speak of, and would be put to sleep.
  reduced.sleep.reset();
  for (SceneBody& body : reduced.bodies) {
    body.velocity = {};
    body.angular_velocity = 0;
  }
  bool any = false;
  if (const RegisteredComponent* law = scene.contact.component; law != nullptr) {
    for (std::vector<double>& row : reduced.interface_values)
      any = reduce({law->component->interface_parameters, law->component->interface_parameter_count}, factor,
                   row) ||
            any;
  }
  for (SceneMaterial& material : reduced.materials) {
    any = reduce(material.model, factor) || any;
  }
  if (!any)
    throw InputError(
        "no interface and no material of the scene has friction, cohesion or tensile strength to reduce");
  return reduced;
}

}  // namespace talus
