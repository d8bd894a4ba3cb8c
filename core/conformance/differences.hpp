#pragma once

#include "conformance/driven_law.hpp"

#include <optional>
#include <string>

namespace talus::conformance {

/// First difference in bits between what two calls say of the active pairs of a batch, in words.
std::optional<std::string> difference_of(const GivenBatch& batch, const TakenLoads& p, const TakenLoads& q,
                                         bool with_reports = true);

/// Of the same pairs, whichever slots they have.
std::optional<std::string> difference_of(const Evaluation& p, const Evaluation& q);

}  // namespace talus::conformance
