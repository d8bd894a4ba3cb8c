#include "schema/keys.hpp"

#include "scene/parameter_text.hpp"
#include "schema/shapes.hpp"

#include <fmt/format.h>

namespace talus {

Key number_key(const Parameter& parameter) {
  return {parameter.key,         parameter.unit,     default_text(parameter),
          range_text(parameter), parameter.sentence, shape::value(parameter)};
}

Key whole_key(const Parameter& parameter) {
  Key key = number_key(parameter);
  key.range = "whole, " + key.range;
  key.schema = shape::whole(parameter);
  return key;
}

std::vector<Key> number_keys(std::span<const Parameter> parameters) {
  std::vector<Key> keys;
  for (const Parameter& parameter : parameters) keys.push_back(number_key(parameter));
  return keys;
}

Key pair_key(const Parameter& parameter) {
  Key key = number_key(parameter);
  key.range = "[x, y]";
  if (has_plain_default(parameter)) key.default_text = fmt::format("[{0}, {0}]", parameter.default_value);
  key.schema = shape::pair(key.schema);
  return key;
}

Key function_key(const Parameter& parameter) {
  Key key = number_key(parameter);
  key.range = "function";
  key.schema = shape::function(parameter, true);
  return key;
}

Key functions_key(const Parameter& parameter, Axes axes, bool of_place) {
  Key key = pair_key(parameter);
  const OrderedJson each = shape::function(parameter, of_place);
  key.range = fmt::format("[x, y], functions{}", of_place ? "" : " of time");
  if (axes == Axes::may_be_free) key.range += " or null";
  key.schema = shape::pair(axes == Axes::both ? each : shape::either(each, {{"type", "null"}}));
  return key;
}

Key worded_key(const Parameter& parameter, const std::vector<std::string>& words) {
  Key key = number_key(parameter);
  key.schema = shape::either(key.schema, shape::one_of(words));
  for (const std::string& word : words) key.range += fmt::format(", \"{}\"", word);
  return key;
}

Key number_key_or(const Parameter& parameter, const char* default_in_words) {
  Key key = number_key(parameter);
  key.default_text = default_in_words;
  return key;
}

Key body_key(const char* sentence) {
  return {"body", "", "required", "name", sentence, shape::text()};
}

Key surface_key() {
  return {"surface", "", "required", "name", "A surface of that body.", shape::text()};
}

Key name_key(const char* sentence) {
  return {"name", "", "required", "unique", sentence, shape::name()};
}

Key line_surface_key() {
  return {"surface",
          "",
          "not set",
          "name",
          "Surface that both faces belong to, for interfaces and loads; without it they take part by the "
          "body's material.",
          shape::name()};
}

Key list_key(const char* name, const char* sentence, const char* definition, std::size_t fewest) {
  return {name, "", "[]", "list", sentence, shape::list(shape::reference(definition), fewest)};
}

Key object_key(const char* name, const char* default_in_words, const char* sentence, const char* definition) {
  return {name, "", default_in_words, "object", sentence, shape::reference(definition)};
}

}  // namespace talus
