#pragma once

#include <talus/parameter.hpp>

#include <map>
#include <span>
#include <string>
#include <vector>

namespace talus::conformance {

/// Parameters by key, in the unit a user writes.
using Values = std::map<std::string, double>;

Values with(Values values, const Values& changes);

/// An interface that excites everything: friction, damping, different stiffness along and across.
Values lively_interface();
/// Springs and friction without dashpots.
Values undamped_interface();

/// A value that a user may write for a parameter: its default, or one by its key, its unit and its range.
double sample_value(const Parameter& parameter);

/// Values of a table in declared order, as the scene reader would hand them over: what is given and in the
/// common unit of its key, samples for the rest; angles in radians.
std::vector<double> in_order(std::span<const Parameter> table, const Values& given);

/// "key = value unit" of a whole table, for a reader.
std::string in_words(std::span<const Parameter> table, std::span<const double> values);

}  // namespace talus::conformance
