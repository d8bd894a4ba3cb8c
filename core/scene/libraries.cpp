#include "scene/libraries.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace talus {
namespace {

namespace fs = std::filesystem;

fs::path real_path(const fs::path& file) {
  std::error_code ignored;
  const fs::path found = fs::weakly_canonical(file, ignored);
  return found.empty() ? file : found;
}

/// Or offered, so that it is loaded where the scene names what it brings.
bool is_at_hand(const Registry& registry, const fs::path& file) {
  const auto is_it = [&](const auto& entry) { return real_path(entry.file) == file; };
  return std::ranges::any_of(registry.components(), is_it) || std::ranges::any_of(registry.offered, is_it);
}

}  // namespace

void read_libraries(Reading& reading, Section& root, const fs::path& folder, bool allowed) {
  OrderedJson resolved = OrderedJson::array();
  root.list(
      "plugins", "a list of paths [\"./libmylaw.so\"]", [&](const Json& value, const std::string& pointer) {
        if (!value.is_string() || value.get<std::string>().empty()) {
          reading.mistakes.add(
              pointer, fmt::format("{} is not allowed here: expected the path of a library", shown(value)));
          return;
        }
        const fs::path file = real_path(fs::absolute(folder / value.get<std::string>()));
        resolved.push_back(file.string());  // the resolved scene may be read from another folder
        if (is_at_hand(reading.registry, file)) return;
        if (allowed) {
          load_library(reading.registry, file);
        } else {
          reading.mistakes.add(pointer,
                               fmt::format("{} would run code of its own: a scene that names a library needs "
                                           "--allow-plugins; give it if you trust the file",
                                           shown(value)));
        }
      });
  root.resolved["plugins"] = std::move(resolved);
}

}  // namespace talus
