#include "commands.hpp"
#include "exit_code.hpp"
#include "plugin/refusal.hpp"
#include "scene/overrides.hpp"
#include "scene_options.hpp"
#include "schema/lookup.hpp"
#include "text/nearest.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace talus {

namespace {

void print_keys(const std::string& title, const std::vector<Key>& keys) {
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

void print_section(const Part& section) {
  fmt::print("{} (section of a scene)\n", section.pointer);
  print_keys("Keys", section.keys);
}

[[noreturn]] void refuse(const Usage& usage, const std::string& name, const Registry& registry,
                         const std::vector<Part>& parts) {
  std::vector<std::string> names = pointers_beside(parts, registry, name);
  if (names.empty()) {
    for (const RegisteredComponent& entry : registry.components()) names.emplace_back(entry.component->name);
    for (const Part& part : parts) names.push_back(part.pointer);
  }
  for (const RefusedLibrary& refused : registry.refused) {
    if (refused.file.stem().string() == "lib" + name)
      throw UsageError(usage.command, fmt::format("there is nothing named '{}': {} was refused: {}", name,
                                                  refused.file.string(), refused.reason));
  }
  throw UsageError(usage.command, fmt::format("there is nothing named '{}'{}\n       known are: {}", name,
                                              guess(name, names), listed(names)));
}

/// Of a value that a stage sets, as messages point to it, the pointer under which it is set.
std::string without_stage(const std::string& name) {
  const auto parts = split_pointer(name);
  if (!parts || parts->size() < 4 || (*parts)[0] != "stages" || (*parts)[2] != "set") return name;
  std::string pointer = (*parts)[3];
  for (std::size_t i = 4; i < parts->size(); ++i) pointer += '/' + (*parts)[i];
  return pointer;
}

}  // namespace

Usage usage_of_describe() {
  Usage usage{
      "describe", "NAME [options]",
      "Explains a component (a contact law, a material, a cover) or a section of a scene (as /time) with\n"
      "all its parameters: unit, default, range, meaning; or one key, by its name or as messages have it.",
      "NAME",
      "  talus describe overlap_area\n  talus describe /time\n  talus describe friction_angle\n"
      "  talus describe /bodies/3/velocity\n"};
  add_plugin_path(usage);
  return usage;
}

int describe_command(const Words& words) {
  const Usage usage = usage_of_describe();
  const auto given = read_arguments(usage, words);
  if (!given) return exit_code::ok;
  const std::string name = without_stage(text_option(*given, "NAME"));
  const Registry registry = load_registry(usage, *given);
  for (const RegisteredComponent& entry : registry.components()) {
    const bool is_law = entry.component->kind == ComponentKind::contact_model;
    if (name != entry.component->name &&
        !(is_law && name == fmt::format("/contact/{}", entry.component->name)))
      continue;
    print_component(entry);
    return exit_code::ok;
  }
  const std::vector<Part> parts = parts_of_scene();
  if (const Part* section = section_at(parts, name)) {
    print_section(*section);
    return exit_code::ok;
  }
  const std::vector<KeysFound> found = keys_named(parts, registry, name);
  for (const KeysFound& keys : found) print_keys(fmt::format("A key of {}", keys.of), keys.keys);
  if (!found.empty()) return exit_code::ok;
  if (const Part* entry = entry_at(parts, name)) {
    print_section(*entry);
    return exit_code::ok;
  }
  refuse(usage, name, registry, parts);
}

}  // namespace talus
