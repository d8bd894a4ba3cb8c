#pragma once

#include "conformance/trial.hpp"
#include "plugin/registry.hpp"

#include <span>

namespace talus::conformance {

/// What a check works on.
struct Subject {
  const RegisteredComponent* component;
  const Registry* registry;  ///< what else is known, to compare with
};

/// One thing that is due of every component of a kind.
struct Check {
  const char* name;
  const char* sentence;  ///< what is due
  void (*run)(const Subject& subject, Trial& trial);
};

std::span<const Check> contact_checks();
std::span<const Check> material_checks();
std::span<const Check> cover_checks();

// Of all kinds.
void check_parameters(const Subject& subject, Trial& trial);

}  // namespace talus::conformance
