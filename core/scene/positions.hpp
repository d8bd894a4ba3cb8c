#pragma once

#include "scene/read.hpp"

#include <nlohmann/json.hpp>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace talus {

using Json = nlohmann::json;

/// Objects and arrays within each other: enough for any scene, too little to exhaust a stack.
inline constexpr std::size_t deepest_nesting = 64;

/// Bytes of a JSON pointer that are shown.
inline constexpr std::size_t longest_pointer = 1000;

struct Place {
  std::size_t line = 0, column = 0;  ///< from 1; columns count characters, not bytes
};

/// Where a value of the text begins, and its key if it stands in an object.
struct Places {
  Place value, key;
};

struct ParsedText {
  Json value;
  std::vector<Mistake> mistakes;  ///< duplicate keys, and a syntax error
  bool complete = false;          ///< false when a syntax error ended the reading
};

/// Parses JSON with // and /* */ comments. Of a key that stands twice the first one counts.
ParsedText parse_json(const std::string& text, const std::string& file);

/// Second pass, made only when there is something to say: places of these JSON pointers. Those of values that
/// the text does not hold are absent.
std::map<std::string, Places> find_places(const std::string& text, const std::set<std::string>& pointers);

/// `pointer` one level deeper, with ~ and / of the key escaped as a JSON pointer wants it.
std::string below(const std::string& pointer, const std::string& key);
std::string below(const std::string& pointer, std::size_t index);

/// Whether `pointer` leads to `ancestor` or to something in it.
bool is_within(const std::string& pointer, const std::string& ancestor);

}  // namespace talus
