#include "commands.hpp"
#include "exit_code.hpp"
#include "scene/nearest.hpp"
#include "scene/tables.hpp"
#include "scene_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace talus {

namespace {

Usage usage_of_describe() {
  Usage usage{
      "describe", "NAME [options]",
      "Explains a component (a contact law, a material, a cover) or a section of a scene (as /time) with\n"
      "all its parameters: unit, default, range, meaning.",
      "NAME", "  talus describe overlap_area\n  talus describe /time\n"};
  add_plugin_path(usage);
  return usage;
}

std::vector<std::string> choices_of(const Parameter& parameter) {
  std::vector<std::string> choices(1);
  for (const char* letter = parameter.choices; *letter != '\0'; ++letter) {
    if (*letter == '|') {
      choices.emplace_back();
    } else {
      choices.back() += *letter;
    }
  }
  return choices;
}

std::string default_text(const Parameter& parameter) {
  if (std::isnan(parameter.default_value)) return "required";
  switch (parameter.kind) {
    case ParameterKind::flag:
      return parameter.default_value != 0 ? "true" : "false";
    case ParameterKind::choice: {
      const std::vector<std::string> choices = choices_of(parameter);
      const auto position = static_cast<std::size_t>(parameter.default_value);
      return position < choices.size() ? choices[position] : "-";
    }
    case ParameterKind::number:
      break;
  }
  // Sections of a scene say so by values outside of the range.
  if (parameter.default_value == automatic) return "auto";
  if (parameter.default_value == not_set) return "not set";
  return fmt::format("{}", parameter.default_value);
}

std::string range_text(const Parameter& parameter) {
  if (parameter.kind == ParameterKind::flag) return "true, false";
  if (parameter.kind == ParameterKind::choice) return listed(choices_of(parameter));
  const bool below = std::isfinite(parameter.minimum), above = std::isfinite(parameter.maximum);
  // The smallest positive number stands for an open end at zero.
  const bool open = parameter.minimum > 0 && parameter.minimum < 1e-300;
  const std::string low = open ? "> 0" : fmt::format(">= {}", parameter.minimum);
  const std::string high = fmt::format("<= {}", parameter.maximum);
  if (below && above) return low + ", " + high;
  return below ? low : (above ? high : "any");
}

void print_parameters(const char* title, std::span<const Parameter> parameters) {
  if (parameters.empty()) return;
  std::size_t widths[4] = {0, 0, 0, 0};
  std::vector<std::vector<std::string>> rows{{"key", "unit", "default", "range"}};
  for (const Parameter& parameter : parameters) {
    rows.push_back({parameter.key, parameter.unit, default_text(parameter), range_text(parameter)});
  }
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < 4; ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  fmt::print("\n{}\n", title);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    fmt::print("  {:<{}}  {:<{}}  {:<{}}  {:<{}}  {}\n", rows[row][0], widths[0], rows[row][1], widths[1],
               rows[row][2], widths[2], rows[row][3], widths[3],
               row == 0 ? "meaning" : parameters[row - 1].sentence);
  }
}

void print_component(const RegisteredComponent& entry) {
  const Component& component = *entry.component;
  const char* kind = component.kind == ComponentKind::contact_model ? "contact law"
                     : component.kind == ComponentKind::material    ? "material"
                                                                    : "cover";
  fmt::print("{} ({}, from {})\n  {}\n", component.name, kind, entry.file.filename().string(),
             component.sentence);
  print_parameters("Parameters", {component.parameters, component.parameter_count});
  print_parameters("Parameters of an interface",
                   {component.interface_parameters, component.interface_parameter_count});
  if (component.parameter_count + component.interface_parameter_count == 0)
    fmt::print("\nIt has no parameters.\n");
}

}  // namespace

int describe_command(const Words& words) {
  const Usage usage = usage_of_describe();
  const auto given = read_arguments(usage, words);
  if (!given) return exit_code::ok;
  const std::string name = text_option(*given, "NAME");
  const Registry registry = load_registry(usage, *given);
  std::vector<std::string> names;
  bool found = false;
  for (const RegisteredComponent& entry : registry.components()) {
    names.emplace_back(entry.component->name);
    if (name != entry.component->name) continue;
    print_component(entry);
    found = true;
  }
  for (const table::Described& section : table::all) {
    names.emplace_back(section.pointer);
    if (name != section.pointer) continue;
    fmt::print("{} (section of a scene)\n", name);
    print_parameters("Parameters", section.parameters);
    found = true;
  }
  if (found) return exit_code::ok;
  throw UsageError(usage.command, fmt::format("there is nothing named '{}'{}\n       known are: {}", name,
                                              guess(name, names), listed(names)));
}

}  // namespace talus
