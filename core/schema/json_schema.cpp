#include "schema/json_schema.hpp"

#include "scene/components.hpp"
#include "schema/parts.hpp"
#include "schema/shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace talus {
namespace {

/// What an editor shows of a key and offers for it.
OrderedJson property_of(const Key& key) {
  OrderedJson property;
  const bool unitless = key.unit.empty() || key.unit == "-";
  property["title"] = unitless ? key.name : fmt::format("{} [{}]", key.name, key.unit);
  property["description"] =
      key.required() ? key.sentence : fmt::format("{} Default: {}.", key.sentence, key.default_text);
  property.update(key.schema);
  const OrderedJson written = OrderedJson::parse(key.default_text, nullptr, false);
  if (!written.is_discarded()) property["default"] = written;
  return property;
}

void add_keys(OrderedJson& object, const std::vector<Key>& keys) {
  for (const Key& key : keys) {
    object["properties"][key.name] = property_of(key);
    if (key.required()) object["required"].push_back(key.name);
  }
}

OrderedJson closed_object() {
  return {{"type", "object"},
          {"properties", OrderedJson::object()},
          {"required", OrderedJson::array()},
          {"additionalProperties", false}};
}

OrderedJson definition_of(const Part& part) {
  OrderedJson object = closed_object();
  add_keys(object, part.keys);
  object.update(part.conditions);
  return object;
}

std::vector<const Component*> components_of(const Registry& registry, ComponentKind kind) {
  std::vector<const Component*> all;
  for (const RegisteredComponent& entry : registry.components()) {
    if (entry.component->kind == kind) all.push_back(entry.component);
  }
  std::sort(all.begin(), all.end(), [](const Component* a, const Component* b) {
    return std::string_view(a->name) < std::string_view(b->name);
  });
  return all;
}

OrderedJson names_of(const std::vector<const Component*>& components) {
  OrderedJson names = OrderedJson::array();
  for (const Component* component : components) {
    names.push_back({{"const", component->name},
                     {"description", component->sentence == nullptr ? "" : component->sentence}});
  }
  return {{"oneOf", names}};
}

void name_models(OrderedJson& object, const std::vector<const Component*>& components) {
  OrderedJson& model = object["properties"]["model"];
  model.erase("type");
  model.update(names_of(components));
}

OrderedJson model_is(const Component& component) {
  return {{"properties", {{"model", {{"const", component.name}}}}}, {"required", {"model"}}};
}

/// A section whose further keys are those of the "model" it names.
OrderedJson chosen_section(const Part& part, const Registry& registry, ComponentKind kind,
                           const std::string& default_model) {
  const std::vector<const Component*> components = components_of(registry, kind);
  OrderedJson object = definition_of(part);
  name_models(object, components);
  object.erase("additionalProperties");
  OrderedJson own = OrderedJson::object();
  for (const Key& key : part.keys) own[key.name] = true;
  const auto closed = [&](const std::vector<Key>& keys) {
    OrderedJson closed_by{
        {"properties", own}, {"required", OrderedJson::array()}, {"additionalProperties", false}};
    add_keys(closed_by, keys);
    return closed_by;
  };
  OrderedJson choices = OrderedJson::array();
  OrderedJson unchosen = closed({});
  for (const Component* component : components) {
    const std::vector<Key> keys = keys_of(*component);
    if (component->name == default_model) unchosen = closed(keys);
    choices.push_back({{"if", model_is(*component)}, {"then", closed(keys)}});
  }
  choices.push_back({{"if", {{"not", shape::required({"model"})}}}, {"then", std::move(unchosen)}});
  object["allOf"] = std::move(choices);
  return object;
}

/// Laws have sections under their names, chosen or not.
OrderedJson contact_section(const Part& part, const std::vector<const Component*>& laws) {
  OrderedJson object = definition_of(part);
  name_models(object, laws);
  OrderedJson chosen = OrderedJson::array();
  for (const Component* law : laws) {
    OrderedJson section = closed_object();
    add_keys(section, keys_of(*law));
    section["description"] = fmt::format("Parameters of {}.", law->name);
    if (!section["required"].empty())
      chosen.push_back({{"if", model_is(*law)}, {"then", shape::required({law->name})}});
    object["properties"][law->name] = std::move(section);
  }
  if (!chosen.empty()) object["allOf"] = std::move(chosen);
  return object;
}

/// Says of a scene whose "contact" fulfils a condition what its interfaces are.
OrderedJson where_contact(const OrderedJson& condition, const OrderedJson& row) {
  return {{"if", {{"properties", {{"contact", condition}}}, {"required", {"contact"}}}},
          {"then", {{"properties", {{"interfaces", {{"items", row}}}}}}}};
}

bool holds(const std::vector<Key>& keys, const std::string& name) {
  return std::any_of(keys.begin(), keys.end(), [&](const Key& key) { return key.name == name; });
}

/// Rows hold what the chosen law declares, and beside it what it does not read: the common keys, and those of
/// laws that have a section.
class InterfaceRows {
 public:
  explicit InterfaceRows(std::vector<const Component*> laws) : laws_(std::move(laws)) {
    for (const Component* law : laws_) {
      for (const Key& key : interface_keys_of(*law)) {
        if (holds(common_, key.name)) continue;
        Declared& declared = declared_by_[key.name];
        declared.laws.push_back(law->name);
        const OrderedJson property = property_of(key);
        if (std::ranges::find(declared.properties, property) == declared.properties.end())
          declared.properties.push_back(property);
      }
    }
  }

  /// Which keys there are at all.
  OrderedJson any_row(const Part& part) const {
    OrderedJson row = closed_object();
    for (const Key& key : part.keys) {
      if (holds(common_, key.name)) {
        row["properties"][key.name] = true;
      } else {
        add_keys(row, {key});
      }
    }
    for (const auto& [name, declared] : declared_by_) {
      const bool one = declared.properties.size() == 1;
      row["properties"][name] =
          one ? declared.properties[0] : OrderedJson{{"anyOf", OrderedJson(declared.properties)}};
    }
    return row;
  }

  /// What is due with each law.
  OrderedJson conditions() const {
    OrderedJson all = OrderedJson::array();
    for (const Component* law : laws_) {
      const std::vector<Key> keys = interface_keys_of(*law);
      OrderedJson row{{"properties", OrderedJson::object()}, {"required", OrderedJson::array()}};
      add_keys(row, keys);
      add_unread(row, keys);
      all.push_back(where_contact(model_is(*law), row));
    }
    for (const auto& [name, declared] : declared_by_) all.push_back(only_with(name, declared.laws));
    OrderedJson unread{{"properties", OrderedJson::object()}};
    add_unread(unread, {});
    all.push_back({{"if", {{"not", shape::required({"contact"})}}},
                   {"then", {{"properties", {{"interfaces", {{"items", unread}}}}}}}});
    return all;
  }

 private:
  void add_unread(OrderedJson& row, const std::vector<Key>& read) const {
    for (Key key : common_) {
      if (holds(read, key.name)) continue;
      key.default_text = "not read by the chosen law";
      row["properties"][key.name] = property_of(key);
    }
  }

  /// A key that laws alone declare needs one of them to be chosen or to have a section.
  static OrderedJson only_with(const std::string& key, const std::vector<std::string>& laws) {
    OrderedJson mentioned = OrderedJson::array();
    for (const std::string& law : laws) {
      mentioned.push_back(shape::required({law}));
      mentioned.push_back({{"properties", {{"model", {{"const", law}}}}}, {"required", {"model"}}});
    }
    return where_contact({{"not", {{"anyOf", mentioned}}}}, {{"properties", {{key, false}}}});
  }

  std::vector<const Component*> laws_;
  std::vector<Key> common_ = common_interface_keys();
  /// A key that is not common to all, and what may stand under it by one law or the other.
  struct Declared {
    std::vector<std::string> laws;
    std::vector<OrderedJson> properties;
  };
  std::map<std::string, Declared> declared_by_;
};

}  // namespace

OrderedJson scene_schema(const Registry& registry) {
  const std::vector<const Component*> laws = components_of(registry, ComponentKind::contact_model);
  const InterfaceRows rows(laws);
  OrderedJson schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                     {"title", "Scene of talus " TALUS_VERSION}};
  OrderedJson definitions = OrderedJson::object();
  for (const Part& part : parts_of_scene()) {
    if (part.definition == "scene") {
      schema.update(definition_of(part));
    } else if (part.definition == "material") {
      definitions[part.definition] = chosen_section(part, registry, ComponentKind::material, "");
    } else if (part.definition == "cover") {
      definitions[part.definition] =
          chosen_section(part, registry, ComponentKind::cover_builder, default_cover);
    } else if (part.definition == "contact") {
      definitions[part.definition] = contact_section(part, laws);
    } else if (part.definition == "interface") {
      definitions[part.definition] = rows.any_row(part);
    } else {
      definitions[part.definition] = definition_of(part);
    }
  }
  schema["allOf"] = rows.conditions();
  schema["$defs"] = std::move(definitions);
  return schema;
}

}  // namespace talus
