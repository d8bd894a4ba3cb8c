#pragma once

#include "conformance/check.hpp"

namespace talus::conformance {

// What a law stores, takes and gives back along a path, and the stiffness it shows.
void check_potential(const Subject& subject, Trial& trial);
void check_account(const Subject& subject, Trial& trial);
void check_cycles(const Subject& subject, Trial& trial);
void check_stiffness(const Subject& subject, Trial& trial);

/// The part of `account` that is about dashpots.
void expect_dashpots_booked(const Subject& subject, Trial& trial);

}  // namespace talus::conformance
