#include "plugin/refusal.hpp"

#include <fmt/format.h>

namespace talus {

std::string_view kind_in_words(ComponentKind kind) {
  switch (kind) {
    case ComponentKind::contact_model:
      return "contact law";
    case ComponentKind::material:
      return "material";
    case ComponentKind::cover_builder:
      return "cover";
  }
  return "component of an unknown kind";
}

PluginError refusal(const std::filesystem::path& file, std::string_view reason) {
  return PluginError(fmt::format("{}: {}", file.string(), reason));
}

}  // namespace talus
