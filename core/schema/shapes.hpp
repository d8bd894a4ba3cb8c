#pragma once

#include "schema/parts.hpp"

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

}  // namespace talus::shape
