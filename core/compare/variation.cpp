#include "compare/variation.hpp"

#include "files/hash.hpp"
#include "files/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace talus {

namespace {

/// Letters of a name: file systems take 255, and figures of a run have some more.
constexpr std::size_t longest_folder = 200;

std::vector<std::string> split_values(std::string_view text) {
  std::vector<std::string> values(1);
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char letter = text[i];
    if (quoted && letter == '\\' && i + 1 < text.size()) {
      values.back() += letter;
      values.back() += text[++i];
      continue;
    }
    // Within a text that is not in quotes it is a letter like others.
    if (letter == '"' && (quoted || depth > 0 || values.back().find_first_not_of(' ') == std::string::npos))
      quoted = !quoted;
    if (!quoted && (letter == '[' || letter == '{')) ++depth;
    if (!quoted && (letter == ']' || letter == '}')) --depth;
    if (letter == ',' && depth == 0 && !quoted) {
      values.emplace_back();
    } else {
      values.back() += letter;
    }
  }
  return values;
}

}  // namespace

bool Variation::of_time() const {
  return pointer == "/time" || pointer.starts_with("/time/");
}

Variation parse_variation(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos || !text.starts_with('/')) {
    throw InputError(fmt::format("--vary {}: write it as --vary /pointer=value,value", text));
  }
  Variation variation{std::string(text.substr(0, equals)), split_values(text.substr(equals + 1))};
  std::set<std::string> told;
  for (const std::string& value : variation.values) {
    if (value.empty()) throw InputError(fmt::format("--vary {}: a value is empty", text));
    if (!told.insert(value).second)
      throw InputError(fmt::format("--vary {}: '{}' is there twice", text, value));
  }
  return variation;
}

std::string folder_of_value(std::string_view value) {
  std::string name;
  for (const char letter : value) {
    const bool plain = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
                       (letter >= '0' && letter <= '9') ||
                       std::string_view(".+-_").find(letter) != std::string_view::npos;
    name += plain ? letter : '_';
  }
  const bool ascii = std::ranges::all_of(value, [](unsigned char letter) { return letter < 0x80; });
  if (name.size() > longest_folder || !ascii)  // values that look alike have folders of their own
    name = name.substr(0, longest_folder - 33) + '_' + hash_of_bytes(value);
  return name == "." || name == ".." ? "_" : name;
}

}  // namespace talus
