#include "preview/preview.hpp"
#include "preview/values.hpp"
#include "scene/surfaces.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <set>

namespace talus {
namespace {

// No rock comes near these; tonnes, gigapascals and coefficients of friction do.
constexpr double lightest = 100;   ///< kg/m³
constexpr double softest = 1e3;    ///< Pa
constexpr double smoothest = 1.5;  ///< degrees

std::optional<double> value_of(std::span<const Parameter> parameters, const std::vector<double>& values,
                               std::string_view key) {
  const auto at = position_of(parameters, key);
  return at ? std::optional(values[*at]) : std::nullopt;
}

void question_material(const SceneMaterial& material, std::vector<std::string>& raised) {
  if (material.density < lightest) {
    raised.push_back(fmt::format("the density of '{}' is {:.4g} kg/m3: is it given in t/m3?", material.name,
                                 material.density));
  }
  if (material.model.component == nullptr) return;
  const Component& model = *material.model.component->component;
  const auto young =
      value_of({model.parameters, model.parameter_count}, material.model.values, "young_modulus");
  if (young && *young < softest) {
    raised.push_back(
        fmt::format("young_modulus of '{}' is {:.4g} Pa: is it given in MPa or GPa?", material.name, *young));
  }
}

void question_interface(const Scene& scene, std::size_t row, std::vector<std::string>& raised) {
  const Component& law = *scene.contact.component->component;
  const auto value = [&](std::string_view key) {
    return value_of({law.interface_parameters, law.interface_parameter_count}, scene.interface_values[row],
                    key);
  };
  const auto friction = value("friction_angle");
  const double degrees = friction.value_or(0) * 180 / std::numbers::pi;
  if (degrees > 0 && degrees < smoothest) {
    raised.push_back(fmt::format(
        "friction_angle of /interfaces/{} is {:.4g} degrees: is it a coefficient? that would be {:.4g} "
        "degrees",
        row, degrees, std::atan(degrees) * 180 / std::numbers::pi));
  }
  if (degrees > 0 && value("tangential_stiffness") == 0) {
    raised.push_back(fmt::format(
        "tangential_stiffness of /interfaces/{} is 0: its friction of {:.4g} degrees never acts, for what "
        "sticks is held by it",
        row, degrees));
  }
  if (value("normal_stiffness") == 0) {
    raised.push_back(
        fmt::format("normal_stiffness of /interfaces/{} is 0: nothing keeps bodies apart there", row));
  }
}

}  // namespace

void question_units(const Scene& scene, std::vector<std::string>& raised) {
  std::set<std::uint32_t> used;
  for (const SceneBody& body : scene.bodies) used.insert(body.material);
  for (const std::uint32_t material : used) question_material(scene.materials[material], raised);
  if (scene.contact.component == nullptr) return;
  std::set<std::uint32_t> rows;
  const std::vector<bool> meet = meetings(scene);
  for (std::size_t i = 0; i < meet.size(); ++i) {
    if (meet[i]) rows.insert(scene.interface_row[i]);
  }
  for (const std::uint32_t row : rows) question_interface(scene, row, raised);
}

}  // namespace talus
