#include "commands.hpp"
#include "exit_code.hpp"
#include "plugin/refusal.hpp"
#include "scene_options.hpp"

#include <fmt/format.h>

namespace talus {

namespace {

const char* or_dash(const char* text) {
  return text == nullptr || *text == '\0' ? "-" : text;
}

}  // namespace

Usage usage_of_plugins() {
  Usage usage{
      "plugins", "[options]",
      "Lists the folders that are searched, the libraries found there with what they bring, and those\n"
      "that were refused, with the reason.",
      "", "  talus plugins --plugin-path ./my-laws\n"};
  add_plugin_path(usage);
  return usage;
}

int plugins_command(const Words& words) {
  const Usage usage = usage_of_plugins();
  const auto given = read_arguments(usage, words);
  if (!given) return exit_code::ok;
  std::vector<std::filesystem::path> from_command_line;
  for (const std::string& folder : list_option(*given, "plugin-path")) from_command_line.emplace_back(folder);
  const Registry registry = load_registry(usage, *given);
  fmt::print("searched, in this order:\n");
  for (const std::filesystem::path& folder : search_path(from_command_line)) {
    fmt::print("  {}{}\n", folder.string(), std::filesystem::is_directory(folder) ? "" : " (not there)");
  }
  const Library* last = nullptr;
  for (const RegisteredComponent& entry : registry.components()) {
    if (entry.library != last) {
      fmt::print("\n{} {} by {}\n  {}\n", or_dash(entry.library->name), or_dash(entry.library->version),
                 or_dash(entry.library->author), entry.file.string());
    }
    last = entry.library;
    fmt::print("  {:<11} {:<16} {}\n", kind_in_words(entry.component->kind), entry.component->name,
               or_dash(entry.component->sentence));
  }
  if (registry.components().empty()) fmt::print("\nno library was loaded\n");
  for (const RefusedLibrary& refused : registry.refused) {
    fmt::print("\nrefused: {}\n  {}\n", refused.file.string(), refused.reason);
  }
  return exit_code::ok;
}

}  // namespace talus
