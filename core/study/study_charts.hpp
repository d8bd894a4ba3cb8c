#pragma once

#include "study/findings.hpp"

#include <string>
#include <vector>

namespace talus {

/// Error against cost with the front, as SVG; both axes by powers of ten.
std::string study_svg(const StudyPlan& plan, const std::vector<StudyRun>& runs,
                      const StudyFindings& findings);

/// Error against each number that varied, a line for each family with its order; none where no number did.
std::vector<std::string> order_charts(const StudyPlan& plan, const std::vector<StudyRun>& runs,
                                      const StudyFindings& findings);

/// The largest energy residual and the largest overlap of each run, against the first number that varied, or
/// against cost where none did.
std::string residual_svg(const StudyPlan& plan, const std::vector<StudyRun>& runs);
std::string overlap_svg(const StudyPlan& plan, const std::vector<StudyRun>& runs);

}  // namespace talus
