#pragma once

#include "compare/comparison.hpp"

#include <string>

namespace talus {

/// Cost of a run as a ratio to the baseline's.
struct CostRatio {
  double at_equal_dt = 0;
  double at_own_dt = 0;  ///< CPU seconds per step times the steps the run would need at its own automatic dt
  double own_steps = 0;  ///< those steps
};

CostRatio cost_ratio(const ComparedRun& run, const ComparedRun& baseline);

/// compare.json.
std::string comparison_json(const ComparisonOrder& order, const Comparison& comparison);

/// compare.csv: "t [s]", then "<value>/<monitor>.<quantity> [unit]", at the times of the baseline; empty
/// where a run did not get so far.
std::string comparison_csv(const Comparison& comparison);

/// What is shown to a reader.
std::string comparison_table(const ComparisonOrder& order, const Comparison& comparison);

}  // namespace talus
