#pragma once

#include "scene/section.hpp"

#include <talus/library.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace talus {

/// A key of an object in a scene: what the reference says of it, and as JSON Schema what may stand there.
struct Key {
  std::string name, unit;
  std::string default_text;  ///< as written in a scene, in words, or "required"
  std::string range, sentence;
  OrderedJson schema;

  bool required() const { return default_text == "required"; }
};

Key number_key(const Parameter& parameter);
Key whole_key(const Parameter& parameter);
std::vector<Key> number_keys(std::span<const Parameter> parameters);
/// [x, y] of the parameter.
Key pair_key(const Parameter& parameter);
Key function_key(const Parameter& parameter);
enum class Axes { both, may_be_free };
/// [x, y], each a function.
Key functions_key(const Parameter& parameter, Axes axes, bool of_place = true);
/// A number, or one of these words.
Key worded_key(const Parameter& parameter, const std::vector<std::string>& words);
/// A number whose default the program finds by itself.
Key number_key_or(const Parameter& parameter, const char* default_in_words);
Key body_key(const char* sentence);
Key surface_key();
Key name_key(const char* sentence);
Key line_surface_key();
Key list_key(const char* name, const char* sentence, const char* definition, std::size_t fewest = 0);
Key object_key(const char* name, const char* default_in_words, const char* sentence, const char* definition);

}  // namespace talus
