#include "plugin/registry.hpp"

#include "plugin/refusal.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace talus {

std::optional<std::string> reason_of_clash(const Registry& registry, const Library& library) {
  for (std::uint32_t i = 0; i < library.component_count; ++i) {
    const Component& component = library.components[i];
    const RegisteredComponent* taken = registry.find(component.kind, component.name);
    if (taken != nullptr && taken->library != &library) {
      return fmt::format(
          "found {} '{}', a name that {} has already taken; wanted a name of its own; rename one of the two, "
          "or "
          "keep only one of the files in the folders of plugins",
          kind_in_words(component.kind), component.name, taken->file.string());
    }
  }
  return std::nullopt;
}

void Registry::add(const Library& library, const std::filesystem::path& file,
                   const std::filesystem::path& opened) {
  // The loader hands out the same descriptor for the same file, whatever path or link leads to it.
  const bool known =
      std::ranges::any_of(components_, [&](const auto& entry) { return entry.library == &library; });
  if (known) return;
  if (const auto reason = reason_of_clash(*this, library)) throw refusal(file, *reason);
  for (std::uint32_t i = 0; i < library.component_count; ++i) {
    components_.push_back({&library.components[i], &library, file, opened});
  }
}

const RegisteredComponent* Registry::find(ComponentKind kind, std::string_view name) const {
  const auto entry = std::ranges::find_if(components_, [&](const RegisteredComponent& candidate) {
    return candidate.component->kind == kind && candidate.component->name == name;
  });
  return entry == components_.end() ? nullptr : &*entry;
}

std::vector<std::string> Registry::names(ComponentKind kind) const {
  std::vector<std::string> names;
  for (const RegisteredComponent& entry : components_) {
    if (entry.component->kind == kind) names.emplace_back(entry.component->name);
  }
  std::ranges::sort(names);
  return names;
}

}  // namespace talus
