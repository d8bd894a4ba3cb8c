#include "conformance/contact_calls.hpp"
#include "conformance/contact_setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace talus::conformance {
namespace {

/// Of one call for one pair of quadrilaterals in contact, with history, the quickest of several; s.
double cost_of(const RegisteredComponent& component) {
  DrivenLaw driven(component);
  constexpr std::uint32_t count = 256;
  for (std::uint32_t i = 0; i < count; ++i) {
    driven.bodies.push_back(box(0, 0, 1, 1));
    driven.bodies.push_back(box(0.3, 0.999, 1.2, 2));
    driven.bodies.back().motion.velocity = {0.01, 0};
    driven.met.emplace_back(2 * i, 2 * i + 1);
  }
  driven.step();
  driven.step();
  const GivenBatch batch = driven.given();
  TakenLoads taken(batch, 0);
  double least = 1;
  for (int round = 0; round < 30; ++round) {
    const auto start = std::chrono::steady_clock::now();
    driven.law().evaluate(batch.view(), taken.view(false));
    least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return least / count;
}

}  // namespace

void measure_cost(const Subject& subject, Trial& trial) {
  trial.feed("256 pairs of boxes in contact, one call, the quickest of 30");
  std::string words = fmt::format("{:.3f} µs per pair", 1e6 * cost_of(*subject.component));
  const char* separator = "; beside it ";
  for (const char* name : {"overlap_area", "vertex_edge", "frictionless"}) {
    const RegisteredComponent* other = subject.registry->find(ComponentKind::contact_model, name);
    if (other == nullptr || other->component == subject.component->component) continue;
    words += fmt::format("{}{} {:.3f} µs", separator, name, 1e6 * cost_of(*other));
    separator = ", ";
  }
  trial.figure(words);
}

}  // namespace talus::conformance
