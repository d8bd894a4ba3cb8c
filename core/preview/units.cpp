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
constexpr double heaviest = 3e4;   ///< kg/m³
constexpr double hardest = 5e12;   ///< Pa
constexpr double fastest = 5e3;    ///< m/s², of what a centrifuge can do

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
  if (material.density > heaviest) {
    raised.push_back(
        fmt::format("the density of '{}' is {:.4g} kg/m3: heavier than any matter, is it given in g/m3?",
                    material.name, material.density));
  }
  if (material.model.component == nullptr) return;
  const Component& model = *material.model.component->component;
  const auto young =
      value_of({model.parameters, model.parameter_count}, material.model.values, "young_modulus");
  if (young && *young < softest) {
    raised.push_back(
        fmt::format("young_modulus of '{}' is {:.4g} Pa: is it given in MPa or GPa?", material.name, *young));
  }
  if (young && *young > hardest) {
    raised.push_back(fmt::format("young_modulus of '{}' is {:.4g} Pa: nothing is as stiff; is it in pascals?",
                                 material.name, *young));
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

/// Rows that rule where surfaces can meet.
std::set<std::uint32_t> rows_in_use(const Scene& scene) {
  std::set<std::uint32_t> rows;
  if (scene.contact.component == nullptr) return rows;
  const std::vector<bool> meet = meetings(scene);
  for (std::size_t i = 0; i < meet.size(); ++i) {
    if (meet[i]) rows.insert(scene.interface_row[i]);
  }
  return rows;
}

}  // namespace

void question_bonds(const Scene& scene, std::vector<std::string>& raised) {
  for (const std::uint32_t row : rows_in_use(scene)) {
    const Component& law = *scene.contact.component->component;
    const auto value = [&](std::string_view key) {
      return value_of({law.interface_parameters, law.interface_parameter_count}, scene.interface_values[row],
                      key);
    };
    const auto cohesion = value("cohesion"), strength = value("tensile_strength");
    if (!cohesion || !strength || !(*cohesion > 0) || *strength > 0) continue;
    raised.push_back(
        fmt::format("/interfaces/{} has a cohesion of {:.4g} Pa and no tensile_strength: where a joint opens "
                    "at all, be it for a moment, its cohesion is lost for good",
                    row, *cohesion));
  }
}

void question_units(const Scene& scene, std::vector<std::string>& raised) {
  std::set<std::uint32_t> used;
  for (const SceneBody& body : scene.bodies) used.insert(body.material);
  for (const std::uint32_t material : used) question_material(scene.materials[material], raised);
  const double pull = std::hypot(scene.gravity.x, scene.gravity.y);
  if (pull > fastest) {
    raised.push_back(fmt::format("gravity is {:.4g} m/s2: is it given in mm/s2?", pull));
  }
  for (const std::uint32_t row : rows_in_use(scene)) question_interface(scene, row, raised);
}

}  // namespace talus
