#include "schema/shapes.hpp"

#include "scene/parameter_text.hpp"
#include "scene/tables.hpp"

namespace talus::shape {
namespace {

OrderedJson with_range(OrderedJson schema, const Parameter& parameter) {
  if (is_above_zero(parameter)) {
    schema["exclusiveMinimum"] = 0;
  } else if (is_bound(parameter.minimum)) {
    schema["minimum"] = plain(parameter.minimum);
  }
  if (is_bound(parameter.maximum)) schema["maximum"] = plain(parameter.maximum);
  return schema;
}

/// [[at, value], ...] or the path of a file.
OrderedJson table() {
  return either(list(list({{"type", "number"}}, 2), 2), path());
}

}  // namespace

OrderedJson value(const Parameter& parameter) {
  switch (parameter.kind) {
    case ParameterKind::flag:
      return {{"type", "boolean"}};
    case ParameterKind::choice:
      return one_of(choices_of(parameter));
    case ParameterKind::number:
      break;
  }
  return with_range({{"type", "number"}}, parameter);
}

OrderedJson whole(const Parameter& parameter) {
  return with_range({{"type", "integer"}}, parameter);
}

OrderedJson pair(const OrderedJson& each) {
  return {{"type", "array"}, {"items", each}, {"minItems", 2}, {"maxItems", 2}};
}

OrderedJson function(const Parameter& parameter, bool of_place) {
  OrderedJson properties{{"scale", value(parameter)}, {"time", table()}};
  if (of_place) properties.update({{"x", table()}, {"y", table()}});
  const OrderedJson product{
      {"type", "object"}, {"properties", properties}, {"minProperties", 1}, {"additionalProperties", false}};
  const OrderedJson term = either(value(parameter), product);
  return either(term, list(term, 1));
}

OrderedJson text() {
  return {{"type", "string"}};
}

OrderedJson path() {
  return {{"type", "string"}, {"minLength", 1}};
}

OrderedJson name() {
  return {{"type", "string"},
          {"pattern", "^(?!\\*$)(?! )[^/,.\"\\x00-\\x1f]*[^ /,.\"\\x00-\\x1f]$"},
          {"maxLength", 200}};
}

OrderedJson point() {
  return pair(value(table::coordinate));
}

OrderedJson polygon(std::size_t fewest_points) {
  return list(point(), fewest_points);
}

OrderedJson edges() {
  return {{"type", "object"},
          {"propertyNames", name()},
          {"additionalProperties", list({{"type", "integer"}, {"minimum", 0}})}};
}

OrderedJson list(const OrderedJson& entry, std::size_t fewest) {
  OrderedJson schema{{"type", "array"}, {"items", entry}};
  if (fewest > 0) schema["minItems"] = fewest;
  return schema;
}

OrderedJson either(const OrderedJson& one, const OrderedJson& other) {
  return {{"anyOf", OrderedJson::array({one, other})}};
}

OrderedJson one_of(const std::vector<std::string>& words) {
  return {{"enum", words}};
}

OrderedJson reference(const std::string& definition) {
  return {{"$ref", "#/$defs/" + definition}};
}

OrderedJson required(const std::vector<std::string>& keys) {
  return {{"required", keys}};
}

OrderedJson any_of(const std::vector<std::string>& keys) {
  OrderedJson one = OrderedJson::array();
  for (const std::string& key : keys) one.push_back(required({key}));
  return {{"anyOf", one}};
}

OrderedJson some_of(const char* key) {
  OrderedJson condition = required({key});
  condition["properties"][key]["minItems"] = 1;
  return condition;
}

OrderedJson if_then(const OrderedJson& condition, const OrderedJson& consequence) {
  return {{"if", condition}, {"then", consequence}};
}

OrderedJson forbidden(const std::vector<std::string>& keys) {
  OrderedJson properties = OrderedJson::object();
  for (const std::string& key : keys) properties[key] = false;
  return {{"properties", properties}};
}

}  // namespace talus::shape
