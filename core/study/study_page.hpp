#pragma once

#include "study/findings.hpp"

#include <string>

namespace talus {

/// study.html: one page that needs nothing else. Error against cost with the front, observed orders, energy
/// residual and largest overlap, and all runs with what failed. `command` repeats the study.
std::string study_page(const std::string& title, const std::string& command, const StudyPlan& plan,
                       const std::vector<StudyRun>& runs, const StudyFindings& findings);

}  // namespace talus
