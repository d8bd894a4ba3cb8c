#include "conformance/given_elements.hpp"
#include "conformance/guarded.hpp"
#include "conformance/material_laws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <thread>

namespace talus::conformance {
namespace {

/// First difference between elements [first, first + number) of two responses, in words.
std::optional<std::string> difference_of_elements(const GivenElements& elements, const TakenResponse& p,
                                                  const TakenResponse& q, std::uint32_t first,
                                                  std::uint32_t number) {
  std::optional<std::string> found;
  const auto compare = [&](const char* what, std::uint32_t i, double here, double there) {
    if (!found && std::bit_cast<std::uint64_t>(here) != std::bit_cast<std::uint64_t>(there))
      found = fmt::format("{} of element {}: {:.17g} and {:.17g}", what, i, here, there);
  };
  for (std::uint32_t i = first; i < first + number; ++i) {
    for (std::size_t k = 0; k < 4; ++k) compare("stress", i, p.stress[k][i], q.stress[k][i]);
    compare("energy", i, p.energy[i], q.energy[i]);
    compare("dissipated", i, p.dissipated[i], q.dissipated[i]);
    for (std::size_t k = 0; k < 4 && elements.viscous; ++k)
      compare("viscous stress", i, p.viscous_stress[k][i], q.viscous_stress[k][i]);
    for (std::uint32_t k = 0; k < elements.doubles_per_element; ++k) {
      const std::size_t at = std::size_t{i} * elements.doubles_per_element + k;
      compare("state", i, p.state[at], q.state[at]);
    }
  }
  return found;
}

void expect_equal(Trial& trial, const std::optional<std::string>& found) {
  trial.due(!found, found.value_or(""), "the same bits");
}

TakenResponse respond(const Material& law, const GivenElements& elements, unsigned char before = 0xFF) {
  TakenResponse taken(elements, before);
  law.evaluate(elements.view(0, elements.count), taken.view(elements, 0));
  return taken;
}

GivenElements sample_elements(const Material& law) {
  return {law, lively_path(0.02, 204)};
}

}  // namespace

void check_material_restore(const Subject& subject, Trial& trial) {
  const auto law = sample_material(subject), other = sample_material(subject);
  const std::vector<Tensor> path = lively_path(0.02, 200);
  DrivenElement element(*law);
  for (int i = 0; i < 100; ++i) element.to(path[static_cast<std::size_t>(i)]);
  DrivenElement copy = element;
  const GivenElements elements = sample_elements(*law);
  const TakenResponse first = respond(*law, elements);
  trial.feed(
      "100 steps, state saved, 100 steps; and the last 100 once more from what was saved, after other calls");
  std::vector<Response> responses;
  for (std::size_t i = 100; i < 200; ++i) responses.push_back(element.to(path[i]));
  for (std::size_t i = 100; i < 200; ++i) {
    const Response again = copy.to(path[i]), &due = responses[i - 100];
    const bool same_losses = again.dissipated == due.dissipated && again.viscous_stress == due.viscous_stress;
    trial.due(again.stress == due.stress && again.energy == due.energy && same_losses,
              fmt::format("another response in step {}", i), "the same bits");
  }
  trial.due(copy.state() == element.state(), "another state at the end", "the same bits");
  trial.feed("203 elements in one call, and the same call to another object");
  expect_equal(trial, difference_of_elements(elements, first, respond(*other, elements), 0, elements.count));
  trial.feed("a look at the place where the last step ended, with dt = 0");
  const Response last = element.to(path.back()), look = element.to(path.back(), 0);
  trial.due(look.dissipated == 0, fmt::format("dissipated {:g} J/m³", look.dissipated), "0");
  trial.at_most(std::abs(look.energy - last.energy), 1e-12 * std::abs(last.energy),
                "change of energy [J/m³]");
}

void check_material_split(const Subject& subject, Trial& trial) {
  const auto law = sample_material(subject);
  const GivenElements elements = sample_elements(*law);
  const TakenResponse whole = respond(*law, elements);
  for (const std::uint32_t size : {1U, 3U, 8U, 100U}) {
    trial.feed(fmt::format("203 elements in one call, and in calls of {}", size));
    TakenResponse parts(elements, 0xFF);
    for (std::uint32_t first = 0; first < elements.count; first += size) {
      law->evaluate(elements.view(first, std::min(size, elements.count - first)),
                    parts.view(elements, first));
    }
    expect_equal(trial, difference_of_elements(elements, whole, parts, 0, elements.count));
  }
  trial.feed("203 elements in one call, and in two threads at once, 10 times");
  for (int round = 0; round < 10; ++round) {
    TakenResponse both(elements, 0xFF);
    const std::uint32_t half = elements.count / 2;
    std::thread other(
        [&] { law->evaluate(elements.view(half, elements.count - half), both.view(elements, half)); });
    law->evaluate(elements.view(0, half), both.view(elements, 0));
    other.join();
    expect_equal(trial, difference_of_elements(elements, whole, both, 0, elements.count));
  }
}

void check_material_writes(const Subject& subject, Trial& trial) {
  constexpr unsigned char mark = 0xA5;
  const auto law = sample_material(subject);
  const GivenElements elements = sample_elements(*law), before = elements;
  trial.feed("203 elements between marked zones");
  const TakenResponse whole = respond(*law, elements, mark);
  trial.due(whole.surrounded_by(mark), "writes past the ends of an array",
            "writes to the elements of the batch alone");
  trial.due(!elements.differs_from(before), "a change of what is read-only", "nothing changed");
  trial.feed("a place for nine numbers between marked zones, to stiffest_tangent()");
  Guarded<double> tangent(9);
  tangent.surround(mark);
  law->stiffest_tangent(tangent.data());
  trial.due(tangent.surrounded_by(mark), "writes past the nine of the tangent", "writes to these alone");
  trial.feed("elements 50 to 57 of 203");
  TakenResponse part(elements, mark);
  const TakenResponse untouched(elements, mark);
  law->evaluate(elements.view(50, 7), part.view(elements, 50));
  const auto left = difference_of_elements(elements, untouched, part, 0, 50);
  const auto right = difference_of_elements(elements, untouched, part, 57, elements.count - 57);
  trial.due(!left && !right, "written: " + left.value_or(right.value_or("")),
            "writes to the elements of the batch alone");
}

void check_material_reads(const Subject& subject, Trial& trial) {
  const auto law = sample_material(subject);
  const GivenElements clean = sample_elements(*law);
  const TakenResponse due = respond(*law, clean);
  for (const unsigned char around : {static_cast<unsigned char>(0xFF), static_cast<unsigned char>(0x40)}) {
    trial.feed(fmt::format("203 elements; around every array bytes of 0x{:02X}{}", around,
                           around == 0xFF ? " (NaN)" : ""));
    GivenElements poisoned = clean;
    poisoned.surround(around);
    if (!law->needs_previous_deformation()) {
      for (Guarded<double>& one : poisoned.previous)
        std::ranges::fill(one, std::numeric_limits<double>::quiet_NaN());
      // Without a memory it is asked outside of steps, too.
      if (law->doubles_per_element() == 0) poisoned.dt = std::numeric_limits<double>::quiet_NaN();
    }
    expect_equal(trial, difference_of_elements(clean, due, respond(*law, poisoned, around), 0, clean.count));
  }
}

void check_material_degenerate(const Subject& subject, Trial& trial) {
  const auto law = sample_material(subject);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   inf = std::numeric_limits<double>::infinity();
  const Tensor deformations[] = {{0, 0, 0, 0},         {1, 0, 0, 0},      {-1, 0, 0, 1},
                                 {1, 1, 1, 1},         {nan, 0, 0, 1},    {inf, 0, 0, 1},
                                 {1e200, 0, 0, 1e200}, {1e-300, 0, 0, 1}, {nan, nan, nan, nan}};
  for (const Tensor& f : deformations) {
    for (const double dt : {1e-3, 0.0, nan}) {
      trial.feed(fmt::format("F = [{}, {}; {}, {}], dt = {} s", f[0], f[1], f[2], f[3], dt));
      DrivenElement element(*law);
      element.to({1.01, 0, 0, 1});
      element.to(f, dt);
      element.to(f, dt);
      trial.due(true, "", "");
    }
  }
  for (const Tensor& f : lively_path(0.3, 100)) {
    trial.feed(fmt::format("F = [{:.9g}, {:.9g}; {:.9g}, {:.9g}] at once", f[0], f[1], f[2], f[3]));
    const Response response = DrivenElement(*law).to(f);
    trial.due(
        std::isfinite(size_of(response.stress) + response.energy + response.dissipated + response.viscous),
        "a response that is no finite number", "finite stress and energy");
  }
}

void measure_material_cost(const Subject& subject, Trial& trial) {
  const auto cost = [](const Material& law) {
    const GivenElements elements = sample_elements(law);
    TakenResponse taken(elements, 0);
    double least = 1;
    for (int round = 0; round < 50; ++round) {
      const auto start = std::chrono::steady_clock::now();
      law.evaluate(elements.view(0, elements.count), taken.view(elements, 0));
      least =
          std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    return 1e9 * least / elements.count;
  };
  trial.feed("203 elements, one call, the quickest of 50");
  std::string words = fmt::format("{:.1f} ns per element", cost(*sample_material(subject)));
  const char* separator = "; beside it ";
  for (const char* name : {"linear_elastic", "hypoelastic", "mohr_coulomb"}) {
    const RegisteredComponent* other = subject.registry->find(ComponentKind::material, name);
    if (other == nullptr || other->component == subject.component->component) continue;
    words +=
        fmt::format("{}{} {:.1f} ns", separator, name, cost(*sample_material({other, subject.registry})));
    separator = ", ";
  }
  trial.figure(words);
}

std::span<const Check> material_checks() {
  static constexpr Check checks[] = {
      {"parameters", "declared defaults make a material; other values make one or are refused in words",
       check_parameters},
      {"power", "stress power is energy stored or dissipated; nothing is dissipated below zero", check_power},
      {"losses", "viscous stress takes energy, and there is none at rest and nothing of it in slow motion",
       check_viscous_loss},
      {"objectivity", "rotation makes no stress and turns what there is; no moment", check_objectivity},
      {"potential", "P = ∂W/∂F", check_stress_potential},
      {"tangent", "stiffest_tangent() bounds the speed of waves, and is of its order", check_tangent},
      {"restore", "the same state gives the same bits: all state lives with the host",
       check_material_restore},
      {"split", "the same bits in any split of a batch, in any thread", check_material_split},
      {"writes", "writes only where it may", check_material_writes},
      {"reads", "reads nothing past its arrays, nor what it says it does not need", check_material_reads},
      {"sweep", "elements at once give the forces and the energy that they give one by one",
       check_material_sweep},
      {"degenerate", "large strains give finite stress; what is no number comes to an end",
       check_material_degenerate},
      {"cost", "what an element costs", measure_material_cost}};
  return checks;
}

}  // namespace talus::conformance
