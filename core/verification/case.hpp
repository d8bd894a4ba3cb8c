#pragma once

#include "verification/bench.hpp"
#include "verification/row.hpp"

#include <span>
#include <string>
#include <vector>

namespace talus::verification {

/// A reference case: what is predicted, and how it is measured.
struct Case {
  const char* group;
  const char* name;
  const char* sentence;  ///< the prediction and its reason, one sentence or two
  int seconds;           ///< roughly, on one core: the longest are begun first
  void (*measure)(const Bench& bench, Rows& rows);

  std::string full_name() const { return std::string(group) + '/' + name; }
};

/// All cases, group by group in the order in which they are printed.
std::vector<const Case*> all_cases();

/// Those whose group, name or group/name is one of the patterns, in which * stands for any letters; all where
/// there is no pattern. In the order of all_cases(). Throws InputError with the nearest name where a pattern
/// meets none.
std::vector<const Case*> chosen_cases(const std::vector<std::string>& patterns);

// Each in a file of its own.
std::span<const Case> incline_cases();
std::span<const Case> friction_cases();
std::span<const Case> impact_cases();
std::span<const Case> statics_cases();
std::span<const Case> continuum_cases();
std::span<const Case> mass_cases();
std::span<const Case> hertz_cases();
std::span<const Case> example_cases();
std::span<const Case> same_bits_cases();
std::span<const Case> ratio_cases();
std::span<const Case> shape_cases();
std::span<const Case> step_cases();
std::span<const Case> many_cases();
std::span<const Case> metamorphic_cases();

}  // namespace talus::verification
