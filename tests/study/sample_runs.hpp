#pragma once

#include "study/findings.hpp"

#include <string>

namespace talus {

inline constexpr const char* sample_column = "m.speed [m/s]";

/// A run whose curve is off by `error` everywhere, the reference being 2.
StudyRun run_of(double error, double cpu, double work, const std::string& end = "finished");

/// Of 4e-3, 2e-3, 1e-3, 8e-3 and 5e-4 s.
const StudyPlan& sample_steps();

/// With these steps, one for each.
std::vector<StudyRun> stepped(std::vector<StudyRun> runs);

}  // namespace talus
