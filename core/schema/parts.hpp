#pragma once

#include "schema/keys.hpp"

#include <talus/library.hpp>

#include <string>
#include <vector>

namespace talus {

/// An object of a scene with its keys. What a component declares of its own comes on top.
struct Part {
  std::string pointer;     ///< "/bodies/*", * for any entry
  std::string definition;  ///< what the schema calls it
  std::vector<Key> keys;
  OrderedJson conditions = OrderedJson::object();  ///< what holds of several keys at once, as JSON Schema
};

/// All objects whose keys do not depend on what is installed.
std::vector<Part> parts_of_scene();

/// Keys that a component declares for its own section, and for interfaces.
std::vector<Key> keys_of(const Component& component);
std::vector<Key> interface_keys_of(const Component& law);

/// Keys that interfaces know whatever law is chosen; a law declares those it reads.
std::vector<Key> common_interface_keys();

}  // namespace talus
