#pragma once

#include "conformance/check.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace talus::conformance {

/// A component and what its checks gave.
struct ComponentReport {
  RegisteredComponent component;
  std::vector<Outcome> outcomes;

  std::size_t count(Verdict verdict) const;
  double seconds() const;
};

std::span<const Check> checks_of(ComponentKind kind);

/// Runs all checks of a component, each in a process of its own for at most `seconds`. `tell` hears of each
/// outcome.
ComponentReport check_component(const RegisteredComponent& component, const Registry& others, double seconds,
                                const std::function<void(const Check&, const Outcome&)>& tell);

/// Loads a library in a process of its own first: one that crashes or hangs there is refused, as PluginError.
void load_carefully(Registry& registry, const std::filesystem::path& file, double seconds);

/// "passed", "FAILED", "not claimed", "not run", "figure".
const char* verdict_in_words(Verdict verdict);

/// A JUnit file, and a page that needs no other file; of UTF-8 text.
std::string junit_of(const std::vector<ComponentReport>& reports);
std::string html_of(const std::vector<ComponentReport>& reports);

}  // namespace talus::conformance
