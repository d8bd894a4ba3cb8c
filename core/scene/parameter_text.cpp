#include "scene/parameter_text.hpp"

#include "scene/section.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

namespace talus {
namespace {

/// Plugins cannot know the core's own marks; numbers of this size say the same.
constexpr double beyond_all = 1e300;

}  // namespace

std::vector<std::string> choices_of(const Parameter& parameter) {
  std::vector<std::string> all;
  std::string_view rest = parameter.choices;
  while (true) {
    const std::size_t bar = rest.find('|');
    all.emplace_back(rest.substr(0, bar));
    if (bar == std::string_view::npos) return all;
    rest.remove_prefix(bar + 1);
  }
}

bool is_above_zero(const Parameter& parameter) {
  return parameter.minimum > 0 && parameter.minimum <= 1 / beyond_all;
}

bool is_bound(double limit) {
  return std::abs(limit) < beyond_all;
}

bool has_plain_default(const Parameter& parameter) {
  return std::abs(parameter.default_value) < beyond_all;  // false where it is required, which is NaN
}

std::string default_text(const Parameter& parameter) {
  if (std::isnan(parameter.default_value)) return "required";
  switch (parameter.kind) {
    case ParameterKind::flag:
      return parameter.default_value != 0 ? "true" : "false";
    case ParameterKind::choice:
      return fmt::format("\"{}\"",
                         choices_of(parameter).at(static_cast<std::size_t>(parameter.default_value)));
    case ParameterKind::number:
      break;
  }
  if (parameter.default_value == automatic) return "\"auto\"";
  return has_plain_default(parameter) ? fmt::format("{}", parameter.default_value) : "not set";
}

std::string range_text(const Parameter& parameter) {
  if (parameter.kind == ParameterKind::flag) return "true, false";
  if (parameter.kind == ParameterKind::choice) {
    std::string all;
    for (const std::string& one : choices_of(parameter))
      all += fmt::format("{}\"{}\"", all.empty() ? "" : ", ", one);
    return all;
  }
  const bool below = is_bound(parameter.minimum), above = is_bound(parameter.maximum);
  const std::string low = is_above_zero(parameter) ? "> 0" : fmt::format(">= {}", parameter.minimum);
  const std::string high = fmt::format("<= {}", parameter.maximum);
  if (below && above) return low + ", " + high;
  return below ? low : (above ? high : "any");
}

}  // namespace talus
