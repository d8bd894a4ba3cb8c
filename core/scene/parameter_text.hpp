#pragma once

#include <talus/parameter.hpp>

#include <string>
#include <vector>

namespace talus {

/// The words of a choice, in declared order.
std::vector<std::string> choices_of(const Parameter& parameter);

/// Whether the parameter must be greater than zero: the smallest numbers stand for an open end of its range.
bool is_above_zero(const Parameter& parameter);

/// Whether a minimum or maximum keeps anything out.
bool is_bound(double limit);

/// Whether leaving the parameter out is the same as giving this number; not so where it says "nothing".
bool has_plain_default(const Parameter& parameter);

/// As it is written in a scene, or "required", "not set" or "auto".
std::string default_text(const Parameter& parameter);

/// ">= 0", "> 0, <= 1", "any", or the words of a choice.
std::string range_text(const Parameter& parameter);

}  // namespace talus
