#include "conformance/sample_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>
#include <system_error>

namespace talus::conformance {
namespace {

constexpr double radians_per_degree = std::numbers::pi / 180;

/// What keys of the common vocabulary are measured in. A law that gives one of them another unit means
/// something else by it.
constexpr std::pair<std::string_view, std::string_view> common_units[] = {
    {"normal_stiffness", "Pa/m"}, {"tangential_stiffness", "Pa/m"}, {"friction_angle", "deg"},
    {"normal_damping", "-"},      {"tangential_damping", "-"},      {"cohesion", "Pa"},
    {"tensile_strength", "Pa"}};

bool in_common_unit(const Parameter& parameter) {
  for (const auto& [key, unit] : common_units) {
    if (key == parameter.key) return unit == parameter.unit;
  }
  return true;
}

struct Sample {
  std::string_view word;
  double value;
};

/// Materials and covers: a soft rock, triangles of a quarter of the sample bodies.
constexpr Sample by_key[] = {{"young_modulus", 2e9},  {"poisson_ratio", 0.3},
                             {"friction_angle", 25},  {"cohesion", 1e6},
                             {"size", 0.25},          {"friction_coefficient", 0.5},
                             {"normal_damping", 0.2}, {"tangential_damping", 0.3}};

/// Of quantities at the size that they have at an overlap of 1 mm under 1 MPa.
constexpr Sample by_unit[] = {{"Pa/m²", 1e12},    {"Pa", 1e6},   {"N/m", 1e6},    {"N/m2", 1e9},
                              {"N/m per m", 1e9}, {"deg", 25},   {"m", 1e-3},     {"s", 1e-4},
                              {"Pa s/m", 1e4},    {"J/m2", 1e3}, {"kg/m3", 2000}, {"m/s", 1}};

/// 1 MPa at an overlap of 1 mm, whatever the power of the depth: "Pa/m", "Pa/m2", "Pa/m^1.5".
std::optional<double> by_power_of_depth(std::string_view unit) {
  constexpr std::string_view lead = "Pa/m";
  if (!unit.starts_with(lead)) return std::nullopt;
  unit.remove_prefix(lead.size());
  if (unit.empty()) return 1e9;
  if (unit.starts_with('^')) unit.remove_prefix(1);
  double power = 0;
  const auto [end, problem] = std::from_chars(unit.data(), unit.data() + unit.size(), power);
  if (problem != std::errc{} || end != unit.data() + unit.size()) return std::nullopt;
  return 1e6 * std::pow(1e3, power);
}

}  // namespace

Values with(Values values, const Values& changes) {
  for (const auto& [key, value] : changes) values[key] = value;
  return values;
}

Values lively_interface() {
  return {{"normal_stiffness", 1e9},
          {"tangential_stiffness", 7e8},
          {"friction_angle", 25},
          {"normal_damping", 0.2},
          {"tangential_damping", 0.3}};
}

Values undamped_interface() {
  return with(lively_interface(), {{"normal_damping", 0}, {"tangential_damping", 0}});
}

double sample_value(const Parameter& parameter) {
  if (!std::isnan(parameter.default_value)) return parameter.default_value;
  if (parameter.kind != ParameterKind::number) return 0;
  double value = by_power_of_depth(parameter.unit).value_or(0.5);  // of a pure number
  for (const Sample& sample : by_unit) {
    if (sample.word == parameter.unit) value = sample.value;
  }
  for (const Sample& sample : by_key) {
    if (sample.word == parameter.key && in_common_unit(parameter)) value = sample.value;
  }
  return std::clamp(value, parameter.minimum, parameter.maximum);
}

std::vector<double> in_order(std::span<const Parameter> table, const Values& given) {
  std::vector<double> values;
  for (const Parameter& parameter : table) {
    const auto found = given.find(parameter.key);
    const bool taken = found != given.end() && in_common_unit(parameter);
    const double value =
        taken ? std::clamp(found->second, parameter.minimum, parameter.maximum) : sample_value(parameter);
    values.push_back(std::string_view(parameter.unit) == "deg" ? value * radians_per_degree : value);
  }
  return values;
}

std::string in_words(std::span<const Parameter> table, std::span<const double> values) {
  std::string words;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const bool angle = std::string_view(table[i].unit) == "deg";
    words += fmt::format("{}{} = {:.6g}{}{}", i == 0 ? "" : ", ", table[i].key,
                         angle ? values[i] / radians_per_degree : values[i],
                         std::string_view(table[i].unit) == "-" ? "" : " ",
                         std::string_view(table[i].unit) == "-" ? "" : table[i].unit);
  }
  return words.empty() ? "no parameters" : words;
}

}  // namespace talus::conformance
