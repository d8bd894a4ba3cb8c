#include "diagnosis/diagnosis.hpp"

#include "geometry/place.hpp"
#include "scene/tables.hpp"
#include "simulation/time_step.hpp"

#include <talus/library.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

constexpr double deep = 0.01;      ///< share of the width, of an overlap that is no small one any more
constexpr std::size_t around = 2;  ///< steps shown to either side of one of interest

DiagnosedStep look_at(const Simulation& simulation) {
  const EnergyLedger& ledger = simulation.ledger();
  DiagnosedStep step;
  step.time = simulation.time();
  step.dt = simulation.last_dt();
  step.kinetic = ledger.kinetic;
  step.residual = ledger.residual;
  step.damped = ledger.contact_damping_loss;
  step.share = ledger.throughput > 0 ? std::abs(ledger.residual) / ledger.throughput : 0;
  for (const Contact& contact : simulation.contacts()) {
    const double depth = contact.penetration / std::min(simulation.body_width(contact.body_a),
                                                        simulation.body_width(contact.body_b));
    if (!(depth > step.depth)) continue;
    step.depth = depth;
    step.penetration = contact.penetration;
    step.body_a = contact.body_a;
    step.body_b = contact.body_b;
    step.place = contact.point;
  }
  if (step.depth > 0) return step;
  // Of a state whose run recorded no contacts there is nothing but the deepest of those that were not asleep.
  const DeepestOverlap deepest = simulation.deepest_overlap();
  step.depth = deepest.penetration /
               std::min(simulation.body_width(deepest.body_a), simulation.body_width(deepest.body_b));
  step.penetration = deepest.penetration;
  step.body_a = deepest.body_a;
  step.body_b = deepest.body_b;
  return step;
}

/// `limit`: share of the throughput that a run may miss.
std::optional<std::size_t> first_bad_of(const std::vector<DiagnosedStep>& steps, double limit) {
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const bool numbers = std::isfinite(steps[i].kinetic) && std::isfinite(steps[i].residual);
    if (!numbers || steps[i].share > limit || (steps[i].depth > deep && steps.front().depth <= deep))
      return i;
  }
  return std::nullopt;
}

std::string name_of(const Scene& scene, std::uint32_t body) {
  return "'" + scene.bodies[body].name + "'";
}

void advise_on_step(const Scene& scene, const CriticalStep& bound, double dt,
                    std::vector<std::string>& advice) {
  if (dt < hardly_the_step * bound.dt) {
    advice.push_back(
        fmt::format("the step is {:.2g} of the stable one and hardly to blame: `talus check-plugin` tells "
                    "whether law and materials book what they take",
                    dt / bound.dt));
  } else if (!scene.time.dt) {
    advice.push_back(
        fmt::format("/time/safety is {:.3g}: try {:.2g}; if the trouble stays, it is not the step",
                    scene.time.safety, scene.time.safety / 4));
  } else if (*scene.time.dt > bound.dt) {
    advice.push_back(
        fmt::format("/time/dt is {:.3g} times the stable step: take \"auto\", or less than {:.3g} s",
                    *scene.time.dt / bound.dt, bound.dt));
  } else if (*scene.time.dt > table::safety_with_contact * bound.spring_dt) {
    advice.push_back(
        fmt::format("/time/dt is {:.2g} of the bound of contacts and supports, above {} they gain or lose "
                    "energy: take \"auto\", "
                    "or less than {:.3g} s",
                    *scene.time.dt / bound.spring_dt, table::safety_with_contact,
                    table::safety_with_contact * bound.spring_dt));
  }
}

void advise_on_overlap(const Scene& scene, const std::vector<DiagnosedStep>& steps,
                       std::vector<std::string>& advice) {
  const DiagnosedStep &first = steps.front(),
                      &deepest =
                          *std::max_element(steps.begin(), steps.end(),
                                            [](const auto&p, const auto&q) { return p.depth < q.depth; });
  if (first.depth > deep) {
    advice.push_back(
        fmt::format("{} and {} overlapped by {:.2g} % of the smaller width before anything went wrong: part "
                    "them, add a settle stage, or raise the normal_stiffness of their interface",
                    name_of(scene, first.body_a), name_of(scene, first.body_b), 100 * first.depth));
  } else if (deepest.depth > deep) {
    advice.push_back(
        fmt::format("the overlap of {} and {} grows to {:.2g} % of the smaller width: raise the "
                    "normal_stiffness of their interface, by some {:.2g} times where weight presses them "
                    "together, by its square where they collide",
                    name_of(scene, deepest.body_a), name_of(scene, deepest.body_b), 100 * deepest.depth,
                    deepest.depth / deep));
  }
}

std::vector<std::string> advice_for(const Scene& scene, const Diagnosis& diagnosis) {
  const bool unbalanced = !(diagnosis.steps.back().share <= scene.limits.energy_residual);
  std::vector<std::string> advice;
  if (unbalanced || scene.time.dt) advise_on_step(scene, diagnosis.bound, diagnosis.steps.back().dt, advice);
  advise_on_overlap(scene, diagnosis.steps, advice);
  const Component* law = scene.contact.component == nullptr ? nullptr : scene.contact.component->component;
  // As the error of the run: the work of dashpots is booked to the first order in the step.
  const DiagnosedStep& last = diagnosis.steps.back();
  if (unbalanced && law != nullptr)
    advice.emplace_back(
        last.damped * last.share > scene.limits.energy_residual * std::abs(last.residual)
            ? "give the interface less normal_damping, if a smaller step does not do"
            : "damp the contacts (normal_damping, tangential_damping of the interface) if they "
              "bounce where they should rest");
  if (unbalanced && law != nullptr && (law->traits & trait::has_potential) == 0)
    advice.push_back(fmt::format(
        "where that changes nothing, '{}', which has no potential, makes or loses the energy; see "
        "whether overlap_area, which has one, does",
        law->name));
  return advice;
}

std::string row(const Scene& scene, const DiagnosedStep& step, const char* mark) {
  const std::string between =
      step.penetration > 0
          ? fmt::format("{:>12.4g}{:>10.3g} %  {} and {}", step.penetration, 100 * step.depth,
                        name_of(scene, step.body_a), name_of(scene, step.body_b))
          : fmt::format("{:>12}", "none");
  return fmt::format("{:>2}{:>18.9g}{:>12.4g}{:>14.4g}{:>14.4g}{:>12.3g} %{}\n", mark, step.time, step.dt,
                     step.kinetic, step.residual, 100 * step.share, between);
}

}  // namespace

Diagnosis diagnose(Simulation& simulation, std::size_t most_steps) {
  Diagnosis diagnosis;
  diagnosis.steps.push_back(look_at(simulation));
  try {
    while (diagnosis.steps.size() <= most_steps && simulation.advance([] { return true; }))
      diagnosis.steps.push_back(look_at(simulation));
  } catch (const NumericalTrouble& trouble) {
    diagnosis.trouble = trouble.what();
    diagnosis.steps.push_back(look_at(simulation));
  }
  diagnosis.bound = simulation.present_bound();
  diagnosis.first_bad = first_bad_of(diagnosis.steps, simulation.scene().limits.energy_residual);
  if (!diagnosis.trouble.empty()) diagnosis.advice = advice_for(simulation.scene(), diagnosis);
  return diagnosis;
}

std::string diagnosis_text(const Scene& scene, const Diagnosis& diagnosis) {
  const std::vector<DiagnosedStep>& steps = diagnosis.steps;
  std::string text = fmt::format("{:>20}{:>12}{:>14}{:>14}{:>14}{:>12}{:>12}\n", "t [s]", "dt [s]",
                                 "kinetic [J/m]", "missed [J/m]", "of throughput", "overlap [m]", "of width");
  bool gap = false;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto near = [&](std::size_t at) { return i + around >= at && i <= at + around; };
    if (!near(0) && !near(steps.size() - 1) && !(diagnosis.first_bad && near(*diagnosis.first_bad))) {
      if (!gap) text += "  […]\n";
      gap = true;
      continue;
    }
    gap = false;
    text += row(scene, steps[i], diagnosis.first_bad == i ? "->" : "");
  }
  if (diagnosis.first_bad) {
    const DiagnosedStep& bad = steps[*diagnosis.first_bad];
    text += fmt::format("first bad step (->): t = {:.9g} s, {} steps after the good state", bad.time,
                        *diagnosis.first_bad);
    if (bad.penetration > 0) {
      text += fmt::format("; worst contact {} and {} at {} m, {:.3g} m deep", name_of(scene, bad.body_a),
                          name_of(scene, bad.body_b), place_from(scene.origin, bad.place), bad.penetration);
    }
    text += '\n';
  }
  text += fmt::format(
      "the step: {:.3g} s; stable up to {:.3g} s ({}); contacts and supports alone {:.3g} s\n",
      steps.back().dt, diagnosis.bound.dt, limiter_of(scene, diagnosis.bound), diagnosis.bound.spring_dt);
  if (!diagnosis.advice.empty()) text += "what to change:\n";
  for (const std::string& advice : diagnosis.advice) text += "  - " + advice + '\n';
  return text;
}

}  // namespace talus
