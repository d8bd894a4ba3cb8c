#pragma once

#include "conformance/trial.hpp"

#include <functional>
#include <string>

namespace talus::conformance {

/// Runs a check in a process of its own: one that crashes, hangs or throws has failed, and nobody else has.
/// `seconds` is the longest it may take.
Outcome run_apart(const std::string& check, double seconds, const std::function<void(Trial&)>& body);

}  // namespace talus::conformance
