#pragma once

#include "conformance/driven_law.hpp"

#include <optional>
#include <string>

namespace talus::conformance {

/// What is compared beside forces and energies. History of a law may hold numbers of pieces and corners.
struct Compared {
  bool reports = true, history = true;
};

/// First difference in bits between what two calls say of the active pairs of a batch, in words.
std::optional<std::string> difference_of(const GivenBatch& batch, const TakenLoads& p, const TakenLoads& q,
                                         const Compared& compared = {});

/// Of the same pairs, whichever slots they have.
std::optional<std::string> difference_of(const Evaluation& p, const Evaluation& q,
                                         const Compared& compared = {});

}  // namespace talus::conformance
