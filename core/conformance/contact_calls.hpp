#pragma once

#include "conformance/check.hpp"

namespace talus::conformance {

// What holds between calls, whatever the forces are.
void check_settling(const Subject& subject, Trial& trial);
void check_restore(const Subject& subject, Trial& trial);
void check_reset(const Subject& subject, Trial& trial);
void check_split(const Subject& subject, Trial& trial);
void check_plan(const Subject& subject, Trial& trial);
void check_writes(const Subject& subject, Trial& trial);
void check_reads(const Subject& subject, Trial& trial);
void check_degenerate(const Subject& subject, Trial& trial);
void measure_cost(const Subject& subject, Trial& trial);

}  // namespace talus::conformance
