#include "scene/overrides.hpp"

#include "scene/section.hpp"
#include "text/nearest.hpp"
#include "text/plain_number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace talus {
namespace {

/// The value as JSON, as a number, or as the text that it is.
std::optional<Json> value_of(const std::string& written, std::string& problem) {
  ParsedText parsed = parse_json(written, {});
  if (parsed.complete && parsed.mistakes.empty()) return std::move(parsed.value);
  if (const std::optional<double> number = plain_number(written)) return Json(*number);
  const std::size_t first = written.find_first_not_of(" \t");
  const bool meant_as_json =
      first != std::string::npos && std::string_view("{[\"").find(written[first]) != std::string_view::npos;
  if (!meant_as_json) return Json(written);
  problem = parsed.mistakes.front().message;
  return std::nullopt;
}

/// Objects that a scene may leave out, by the section they stand in; * stands for any entry of a list.
struct Omissible {
  std::string_view section, key;
};
constexpr Omissible omissible[] = {
    {"", "materials"},
    {"", "cover"},
    {"", "contact"},
    {"", "settle"},
    {"", "time"},
    {"", "output"},
    {"", "limits"},
    {"", "sleep"},
    {"/bodies/*", "cover"},
    {"/bodies/*", "drive"},
    {"/bodies/*", "surfaces"},
    {"/stages/*", "set"},
};

/// Whether an object `key` may be made in `section`.
bool can_be_made(const std::string& section, const std::string& key) {
  // Laws have sections by their names. Which ones exist is not known before the scene's own libraries are
  // loaded; the reader then tells a name that is none.
  if (section == "/contact") return key != "model" && key != "roles";
  return std::any_of(std::begin(omissible), std::end(omissible),
                     [&](const Omissible& one) { return one.section == section && one.key == key; });
}

/// The objects that `parent` has or may have.
std::vector<std::string> known_keys(const Json& parent, const std::string& section) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : parent.items()) keys.push_back(key);
  for (const Omissible& one : omissible) {
    if (one.section == section && !parent.contains(one.key)) keys.emplace_back(one.key);
  }
  std::sort(keys.begin(), keys.end());
  return keys;
}

/// The entry of `parent` named by `part`, with the reason where there is none. `section` is the way to the
/// parent.
Json* step(Json& parent, const std::string& section, const std::string& part, bool is_last,
           std::string& problem) {
  if (parent.is_object()) {
    if (is_last || parent.contains(part)) return &parent[part];
    if (can_be_made(section, part)) return &(parent[part] = Json::object());
    const std::vector<std::string> keys = known_keys(parent, section);
    problem = fmt::format("the scene has no \"{}\" here;{} known: {}", part, did_you_mean(part, keys),
                          listed(keys));
    return nullptr;
  }
  if (!parent.is_array()) {
    problem =
        fmt::format("\"{}\" cannot be set within {}: expected an object or a list", part, shown(parent));
    return nullptr;
  }
  const bool number = !part.empty() && part.size() < 10 && (part == "0" || part[0] != '0') &&
                      part.find_first_not_of("0123456789") == std::string::npos;
  if (number && std::stoul(part) < parent.size()) return &parent[std::stoul(part)];
  problem = parent.empty() ? fmt::format("the list has no entry \"{}\": it is empty", part)
                           : fmt::format("the list has no entry \"{}\": expected a number from 0 to {}", part,
                                         parent.size() - 1);
  return nullptr;
}

/// null: takes away what stands under a key, which is then as if it had been left out.
bool leave_out(Json& scene, const std::vector<std::string>& keys, std::string& problem) {
  std::string section;
  Json* parent = &scene;
  for (std::size_t i = 0; i + 1 < keys.size() && parent != nullptr; ++i) {
    const bool in_list = parent->is_array();
    if (parent->is_object() && !parent->contains(keys[i])) {
      parent = nullptr;  // what is not there holds nothing
    } else {
      parent = step(*parent, section, keys[i], false, problem);
      if (parent == nullptr) return false;
    }
    section += in_list ? "/*" : '/' + keys[i];
  }
  const std::string& key = keys.back();
  if (parent != nullptr && parent->is_object() && parent->erase(key) > 0) return true;
  if (can_be_made(section, key)) return true;
  problem = parent != nullptr && parent->is_array()
                ? "null leaves out what stands under a key, but entries of lists stay: give the list anew"
                : fmt::format("the scene has no \"{}\" here: null leaves out what is there", key);
  return false;
}

void apply(Json& scene, const Override& override_, Mistakes& mistakes) {
  const auto parts = split_pointer(override_.pointer);
  if (!parts) {
    mistakes.add_to_command(command_of(override_), override_.pointer,
                            "this is no JSON pointer: expected one such as /time/dt, with / before each key");
    return;
  }
  std::string problem, missing = override_.pointer;
  std::optional<Json> value = value_of(override_.value, problem);
  const bool done =
      value && (value->is_null() ? leave_out(scene, *parts, problem)
                                 : write_value(scene, *parts, std::move(*value), missing, problem));
  if (!done) mistakes.add_to_command(command_of(override_), missing, problem);
}

}  // namespace

std::optional<std::vector<std::string>> split_pointer(const std::string& pointer) {
  if (!pointer.starts_with('/')) return std::nullopt;
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < pointer.size(); ++i) {
    const char c = pointer[i];
    if (c == '/') {
      parts.emplace_back();
    } else if (c == '~') {
      const char next = i + 1 < pointer.size() ? pointer[++i] : '\0';
      if (next != '0' && next != '1') return std::nullopt;
      parts.back() += next == '0' ? '~' : '/';
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

bool write_value(Json& scene, const std::vector<std::string>& keys, Json value, std::string& missing,
                 std::string& problem) {
  Json *at = &scene, *made_in = nullptr;
  std::string so_far, section, made;  // with the number of an entry, and with * instead
  for (std::size_t i = 0; i < keys.size() && at != nullptr; ++i) {
    const std::string& key = keys[i];
    Json* parent = at;
    const bool is_new = parent->is_object() && !parent->contains(key);
    at = step(*parent, section, key, i + 1 == keys.size(), problem);
    if (at != nullptr && is_new && made_in == nullptr) {
      made_in = parent;
      made = key;
    }
    so_far = below(so_far, key);
    section += parent->is_array() ? "/*" : '/' + key;
  }
  if (at != nullptr) {
    *at = std::move(value);
    return true;
  }
  if (made_in != nullptr) made_in->erase(made);  // nobody asked for an empty section
  missing = so_far;
  return false;
}

void apply_overrides(Json& scene, const std::vector<Override>& overrides, Mistakes& mistakes) {
  for (const Override& override_ : overrides) apply(scene, override_, mistakes);
}

}  // namespace talus
