#include "schema/lookup.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace talus {
namespace {

using Tokens = std::vector<std::string>;

Tokens tokens_of(const std::string& pointer) {
  Tokens tokens;
  for (std::size_t at = 1; at < pointer.size();) {
    const std::size_t end = std::min(pointer.find('/', at), pointer.size());
    tokens.push_back(pointer.substr(at, end - at));
    at = end + 1;
  }
  return tokens;
}

/// Where * stands for any token.
bool begins_with(const Tokens& pattern, const Tokens& given) {
  return given.size() <= pattern.size() &&
         std::equal(given.begin(), given.end(), pattern.begin(),
                    [](const std::string& token, const std::string& wanted) {
                      return wanted == "*" || wanted == token;
                    });
}

/// Keys in one place of a scene: of a section, or of a component where its parameters stand.
struct KeyPlace {
  std::string pointer;  ///< "/bodies/*"
  std::string of;       ///< for a reader
  std::vector<Key> keys;
};

bool leads_to_list(const std::string& given, const std::string& pointer) {
  const Tokens pattern = tokens_of(pointer), tokens = tokens_of(given);
  return tokens.size() + 1 == pattern.size() && pattern.back() == "*" && begins_with(pattern, tokens);
}

bool leads_to_entry(const std::string& given, const std::string& pointer) {
  const Tokens pattern = tokens_of(pointer), tokens = tokens_of(given);
  return tokens.size() == pattern.size() && begins_with(pattern, tokens);
}

std::vector<KeyPlace> places_of(const Component& component) {
  const std::vector<Key> keys = keys_of(component);
  const auto of = [&](const char* pointer) { return fmt::format("{} of {}", pointer, component.name); };
  switch (component.kind) {
    case ComponentKind::contact_model: {
      const std::string own = fmt::format("/contact/{}", component.name);
      return {{own, own, keys}, {"/interfaces/*", of("/interfaces/*"), interface_keys_of(component)}};
    }
    case ComponentKind::material:
      return {{"/materials/*", of("/materials/*"), keys}};
    case ComponentKind::cover_builder:
      return {{"/cover", of("/cover"), keys}};
  }
  return {};
}

/// All of them, each once. A cover of a body or of blocks has the keys of that of the scene.
std::vector<KeyPlace> places_in(const std::vector<Part>& parts, const Registry& registry) {
  std::vector<KeyPlace> places;
  for (const Part& part : parts) {
    places.push_back({part.pointer, part.pointer, part.keys});
    for (const RegisteredComponent& entry : registry.components()) {
      for (KeyPlace& place : places_of(*entry.component)) {
        const std::string section = place.pointer.starts_with("/contact/") ? "/contact" : place.pointer;
        if (section == part.pointer) places.push_back(std::move(place));
      }
    }
  }
  return places;
}

/// Where what the pointer names may stand, and that name; of a bare word anywhere.
struct Holder {
  std::vector<KeyPlace> places;
  std::string above, key;

  Holder(const std::vector<Part>& parts, const Registry& registry, const std::string& name) {
    const std::size_t slash = name.rfind('/');
    const bool bare = slash == std::string::npos;
    key = bare ? name : name.substr(slash + 1);
    above = bare ? "" : name.substr(0, slash);
    for (KeyPlace& place : places_in(parts, registry)) {
      const bool cover = place.pointer == "/cover" && (leads_to_entry(above, "/bodies/*/cover") ||
                                                       leads_to_entry(above, "/blocks/*/cover"));
      if (bare || cover || leads_to_entry(above, place.pointer) || leads_to_list(above, place.pointer))
        places.push_back(std::move(place));
    }
  }
};

}  // namespace

const Part* section_at(const std::vector<Part>& parts, const std::string& pointer) {
  const auto is_it = [&](const Part& part) {
    return part.pointer == pointer || leads_to_list(pointer, part.pointer) ||
           (!part.pointer.ends_with('*') && leads_to_entry(pointer, part.pointer));
  };
  const auto found = std::find_if(parts.begin(), parts.end(), is_it);
  return pointer.starts_with('/') && found != parts.end() ? &*found : nullptr;
}

const Part* entry_at(const std::vector<Part>& parts, const std::string& pointer) {
  const auto found = std::find_if(parts.begin(), parts.end(),
                                  [&](const Part& part) { return leads_to_entry(pointer, part.pointer); });
  return pointer.starts_with('/') && found != parts.end() ? &*found : nullptr;
}

std::vector<KeysFound> keys_named(const std::vector<Part>& parts, const Registry& registry,
                                  const std::string& name) {
  std::vector<KeysFound> found;
  Holder holder(parts, registry, name);
  for (KeyPlace& place : holder.places) {
    std::erase_if(place.keys, [&](const Key& key) { return key.name != holder.key; });
    if (!place.keys.empty()) found.push_back({place.of, std::move(place.keys)});
  }
  return found;
}

std::vector<std::string> pointers_beside(const std::vector<Part>& parts, const Registry& registry,
                                         const std::string& pointer) {
  std::vector<std::string> names;
  if (!pointer.starts_with('/')) return names;
  const Holder holder(parts, registry, pointer);
  for (const KeyPlace& place : holder.places) {
    for (const Key& key : place.keys) names.push_back(holder.above + '/' + key.name);
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace talus
