#pragma once

#include "study/findings.hpp"

#include <string>

namespace talus {

/// study.csv: a row per run.
std::string study_csv(const StudyPlan& plan, const std::vector<StudyRun>& runs,
                      const StudyFindings& findings);

/// study.json: the same with the front, the orders and what failed, and why.
std::string study_json(const StudyPlan& plan, const std::vector<StudyRun>& runs,
                       const StudyFindings& findings);

/// What is shown to a reader: the runs from the cheapest, the front, the orders, and what failed.
std::string study_table(const StudyPlan& plan, const std::vector<StudyRun>& runs,
                        const StudyFindings& findings);

}  // namespace talus
