#pragma once

#include "scene/section.hpp"

#include <talus/library.hpp>

#include <string>

/// What may stand under a key, as JSON Schema.
namespace talus::shape {

OrderedJson value(const Parameter& parameter);
OrderedJson whole(const Parameter& parameter);  ///< a number without fraction
OrderedJson pair(const OrderedJson& each);      ///< [x, y]
OrderedJson function(const Parameter& parameter, bool of_place);
OrderedJson text();
OrderedJson path();
OrderedJson name();  ///< what check_name() allows
OrderedJson point();
OrderedJson polygon(std::size_t fewest_points);
OrderedJson edges();  ///< {"surface": [0, 1]}
OrderedJson list(const OrderedJson& entry, std::size_t fewest = 0);
OrderedJson either(const OrderedJson& one, const OrderedJson& other);
OrderedJson one_of(const std::vector<std::string>& words);
OrderedJson reference(const std::string& definition);
OrderedJson required(const std::vector<std::string>& keys);

// What holds of several keys at once.
OrderedJson any_of(const std::vector<std::string>& keys);  ///< one of them is there
OrderedJson some_of(const char* key);                      ///< that list with something in it
OrderedJson if_then(const OrderedJson& condition, const OrderedJson& consequence);
OrderedJson forbidden(const std::vector<std::string>& keys);

}  // namespace talus::shape
