#pragma once

#include "compare/comparison.hpp"

#include <optional>
#include <string>

namespace talus {

/// Cost of a run as a ratio to the baseline's.
struct CostRatio {
  std::optional<double> at_equal_dt;  ///< nothing unless both made a step
  /// CPU seconds per step times the steps the run would need at its own automatic dt, and those steps;
  /// nothing unless both came to their end.
  std::optional<double> at_own_dt, own_steps;
};

/// The reference as it was read, in the folder of the comparison.
inline constexpr const char* reference_copy = "compare_reference.csv";

CostRatio cost_ratio(const ComparedRun& run, const ComparedRun& baseline);

/// compare.json.
std::string comparison_json(const ComparisonOrder& order, const Comparison& comparison);

/// The same before there are runs: which folders are theirs, should nobody come to write more, and which
/// `others` of an earlier comparison are still there.
std::string begun_comparison_json(const ComparisonOrder& order,
                                  const std::vector<std::filesystem::path>& others);

/// compare.csv: "t [s]", then "<value>/<monitor>.<quantity> [unit]", at the times of the baseline; empty
/// where a run did not get so far.
std::string comparison_csv(const Comparison& comparison);

/// What is shown to a reader.
std::string comparison_table(const ComparisonOrder& order, const Comparison& comparison);

}  // namespace talus
