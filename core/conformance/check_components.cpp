#include "conformance/check_components.hpp"

#include "conformance/apart.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace talus::conformance {

std::size_t ComponentReport::count(Verdict verdict) const {
  return static_cast<std::size_t>(std::ranges::count(outcomes, verdict, &Outcome::verdict));
}

double ComponentReport::seconds() const {
  double sum = 0;
  for (const Outcome& outcome : outcomes) sum += outcome.seconds;
  return sum;
}

std::span<const Check> checks_of(ComponentKind kind) {
  switch (kind) {
    case ComponentKind::contact_model:
      return contact_checks();
    case ComponentKind::material:
      return material_checks();
    case ComponentKind::cover_builder:
      return cover_checks();
  }
  return {};
}

ComponentReport check_component(const RegisteredComponent& component, const Registry& others, double seconds,
                                const std::function<void(const Check&, const Outcome&)>& tell) {
  ComponentReport report{component, {}};
  const Subject subject{&report.component, &others};
  bool stands = true;  // without an object of it nothing else can be asked
  for (const Check& check : checks_of(component.component->kind)) {
    Outcome outcome{check.name, Verdict::not_run, "", "the check 'parameters' failed", "", 0, 0};
    if (stands) {
      outcome = run_apart(check.name, seconds, [&](Trial& trial) { check.run(subject, trial); });
    }
    if (check.run == check_parameters) stands = outcome.verdict != Verdict::failed;
    tell(check, outcome);
    report.outcomes.push_back(std::move(outcome));
  }
  return report;
}

void load_carefully(Registry& registry, const std::filesystem::path& file, double seconds) {
  const Outcome loaded = run_apart("load", seconds, [&](Trial&) {
    Registry trial_run;
    trial_run.simd = registry.simd;
    try {
      load_library(trial_run, file);
    } catch (const PluginError&) {  // said again where it is loaded
    }
  });
  if (loaded.verdict == Verdict::failed) {
    throw PluginError(
        fmt::format("{}: found {} while it was loaded, wanted a library that loads; make its static "
                    "objects do nothing and rebuild it",
                    file.string(), loaded.found));
  }
  load_library(registry, file);
}

const char* verdict_in_words(Verdict verdict) {
  switch (verdict) {
    case Verdict::passed:
      return "passed";
    case Verdict::failed:
      return "FAILED";
    case Verdict::not_claimed:
      return "not claimed";
    case Verdict::not_run:
      return "not run";
    case Verdict::figure:
      return "figure";
  }
  return "";
}

}  // namespace talus::conformance
