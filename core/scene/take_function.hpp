#pragma once

#include "scene/reading.hpp"

#include <array>
#include <optional>

namespace talus {

/// Whether a value may depend on time alone or on the position at the start, too.
enum class Varies { in_time, in_time_and_place };

/// A number, a product {"scale", "time", "x", "y"} of tables, or a list of both, which is a sum. Zero after a
/// mistake. `resolved` is the same with absolute paths of files.
Function take_function(Reading& reading, const Parameter& parameter, const Json& value,
                       const std::string& pointer, Varies varies, OrderedJson& resolved);

/// A function of the section; nothing if absent.
std::optional<Function> optional_function(Reading& reading, Section& section, const Parameter& parameter);

/// A list of two functions, zero if absent; a mistake if absent and required.
VectorFunction vector_function(Reading& reading, Section& section, const Parameter& parameter,
                               Varies varies = Varies::in_time_and_place);

/// The same where null leaves an axis free, as do absent values.
std::array<std::optional<Function>, 2> free_vector_function(Reading& reading, Section& section,
                                                            const Parameter& parameter);

}  // namespace talus
