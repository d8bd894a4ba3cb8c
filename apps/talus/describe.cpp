#include "commands.hpp"
#include "exit_code.hpp"
#include "plugin/refusal.hpp"
#include "scene/nearest.hpp"
#include "scene_options.hpp"
#include "schema/parts.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace talus {

namespace {

void print_keys(const char* title, const std::vector<Key>& keys) {
  if (keys.empty()) return;
  std::size_t widths[4] = {0, 0, 0, 0};
  std::vector<std::vector<std::string>> rows{{"key", "unit", "default", "range", "meaning"}};
  for (const Key& key : keys) rows.push_back({key.name, key.unit, key.default_text, key.range, key.sentence});
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < 4; ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  fmt::print("\n{}\n", title);
  for (const auto& row : rows) {
    fmt::print("  {:<{}}  {:<{}}  {:<{}}  {:<{}}  {}\n", row[0], widths[0], row[1], widths[1], row[2],
               widths[2], row[3], widths[3], row[4]);
  }
}

void print_component(const RegisteredComponent& entry) {
  const Component& component = *entry.component;
  fmt::print("{} ({}, from {})\n  {}\n", component.name, kind_in_words(component.kind),
             entry.file.filename().string(), component.sentence);
  print_keys("Parameters", keys_of(component));
  print_keys("Parameters of an interface", interface_keys_of(component));
  if (component.parameter_count + component.interface_parameter_count == 0)
    fmt::print("\nIt has no parameters.\n");
}

}  // namespace

Usage usage_of_describe() {
  Usage usage{
      "describe", "NAME [options]",
      "Explains a component (a contact law, a material, a cover) or a section of a scene (as /time) with\n"
      "all its parameters: unit, default, range, meaning.",
      "NAME", "  talus describe overlap_area\n  talus describe /time\n"};
  add_plugin_path(usage);
  return usage;
}

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
  for (const Part& part : parts_of_scene()) {
    names.push_back(part.pointer);
    if (name != part.pointer) continue;
    fmt::print("{} (section of a scene)\n", name);
    print_keys("Keys", part.keys);
    found = true;
  }
  if (found) return exit_code::ok;
  throw UsageError(usage.command, fmt::format("there is nothing named '{}'{}\n       known are: {}", name,
                                              guess(name, names), listed(names)));
}

}  // namespace talus
