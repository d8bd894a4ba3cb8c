#pragma once

#include "conformance/check.hpp"

namespace talus::conformance {

// What the forces of one evaluation, and the same seen otherwise, must be.
void check_balance(const Subject& subject, Trial& trial);
void check_translation(const Subject& subject, Trial& trial);
void check_rotation(const Subject& subject, Trial& trial);
void check_reflection(const Subject& subject, Trial& trial);
void check_order(const Subject& subject, Trial& trial);
void check_galilean(const Subject& subject, Trial& trial);
void check_gap(const Subject& subject, Trial& trial);
void check_tension(const Subject& subject, Trial& trial);
void check_interfaces(const Subject& subject, Trial& trial);
void check_friction_limit(const Subject& subject, Trial& trial);
void check_reports(const Subject& subject, Trial& trial);
void check_joint(const Subject& subject, Trial& trial);
void check_strips(const Subject& subject, Trial& trial);

}  // namespace talus::conformance
