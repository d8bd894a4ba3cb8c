#pragma once

#include "compare/comparison.hpp"

namespace talus {

/// Adds to the warnings what the deviations say nothing of, or less than one may think: columns of one run
/// alone, rows at other times, runs that ended early.
void warn_of_what_is_left_out(const ComparisonOrder& order, Comparison& comparison);

}  // namespace talus
