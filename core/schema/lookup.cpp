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

bool leads_to_list(const std::string& pointer, const Part& part) {
  const Tokens pattern = tokens_of(part.pointer), given = tokens_of(pointer);
  return given.size() + 1 == pattern.size() && pattern.back() == "*" && begins_with(pattern, given);
}

bool leads_to_entry(const std::string& pointer, const Part& part) {
  const Tokens pattern = tokens_of(part.pointer), given = tokens_of(pointer);
  return given.size() == pattern.size() && begins_with(pattern, given);
}

/// What a component declares for this section.
std::vector<Key> keys_in(const Part& part, const Component& component) {
  const bool law = component.kind == ComponentKind::contact_model,
             material = component.kind == ComponentKind::material;
  if (law && part.pointer == "/interfaces/*") return interface_keys_of(component);
  const char* const own = law ? "/contact" : material ? "/materials/*" : "/cover";
  return part.pointer == own ? keys_of(component) : std::vector<Key>{};
}

/// The sections that hold what the pointer names, and that name; of a bare word all sections.
struct Holder {
  std::vector<const Part*> parts;
  std::string above, key;

  Holder(const std::vector<Part>& all, const std::string& name) {
    const std::size_t slash = name.rfind('/');
    const bool bare = slash == std::string::npos;
    key = bare ? name : name.substr(slash + 1);
    above = bare ? "" : name.substr(0, slash);
    for (const Part& part : all) {
      if (bare || leads_to_entry(above, part) || leads_to_list(above, part)) parts.push_back(&part);
    }
  }
};

template <class Visit>
void each_list_of_keys(const Part& part, const Registry& registry, const Visit& visit) {
  visit(part.pointer, part.keys);
  for (const RegisteredComponent& entry : registry.components())
    visit(fmt::format("{} of {}", part.pointer, entry.component->name), keys_in(part, *entry.component));
}

}  // namespace

const Part* section_at(const std::vector<Part>& parts, const std::string& pointer) {
  const auto is_it = [&](const Part& part) {
    return part.pointer == pointer || leads_to_list(pointer, part) ||
           (!part.pointer.ends_with('*') && leads_to_entry(pointer, part));
  };
  const auto found = std::find_if(parts.begin(), parts.end(), is_it);
  return pointer.starts_with('/') && found != parts.end() ? &*found : nullptr;
}

const Part* entry_at(const std::vector<Part>& parts, const std::string& pointer) {
  const auto found = std::find_if(parts.begin(), parts.end(),
                                  [&](const Part& part) { return leads_to_entry(pointer, part); });
  return pointer.starts_with('/') && found != parts.end() ? &*found : nullptr;
}

std::vector<KeysFound> keys_named(const std::vector<Part>& parts, const Registry& registry,
                                  const std::string& name) {
  std::vector<KeysFound> found;
  const Holder holder(parts, name);
  for (const Part* part : holder.parts) {
    each_list_of_keys(*part, registry, [&](const std::string& of, std::vector<Key> keys) {
      std::erase_if(keys, [&](const Key& key) { return key.name != holder.key; });
      if (!keys.empty()) found.push_back({of, std::move(keys)});
    });
  }
  return found;
}

std::vector<std::string> pointers_beside(const std::vector<Part>& parts, const Registry& registry,
                                         const std::string& pointer) {
  std::vector<std::string> names;
  if (!pointer.starts_with('/')) return names;
  const Holder holder(parts, pointer);
  for (const Part* part : holder.parts) {
    each_list_of_keys(*part, registry, [&](const std::string&, const std::vector<Key>& keys) {
      for (const Key& key : keys) names.push_back(holder.above + '/' + key.name);
    });
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace talus
