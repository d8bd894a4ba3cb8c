#include "conformance/material_laws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus::conformance {
namespace {

/// Elastic parts of the sample soils and rocks end at strains of some 1e-3; beyond they yield.
constexpr double strains[] = {1e-5, 1e-3, 0.02};
/// Of the modulus: an energy may be a small difference of terms of about that size, each rounded.
constexpr double round_off = 4e-15;

/// One round of strain under a turn of as much, in `steps`: smooth, so that an error of the step shows its
/// order. The chord of a step that turns by θ is worth θ² times the stress, so the turn goes with the strain.
std::vector<Tensor> round_trip(double strain, int steps) {
  std::vector<Tensor> path;
  for (int i = 1; i <= steps; ++i) {
    const double t = 2 * std::numbers::pi * i / steps, swing = strain * (1 - std::cos(t));
    const Tensor stretch{1 + strain * std::sin(t), swing / 2, 0, 1 - swing / 3};
    path.push_back(product(rotation(strain * t), stretch));
  }
  return path;
}

struct Account {
  double missing, turned_over, least_dissipated, viscous, least_viscous, resting;
};

Account account_of(const Material& law, const std::vector<Tensor>& path, double dt = 1e-3) {
  DrivenElement element(law);
  Account account{};
  Response last{};
  double work = 0;
  for (const Tensor& f : path) {
    last = element.to(f, dt);
    account.turned_over += std::abs(element.work() - work);
    work = element.work();
    account.least_dissipated = std::min(account.least_dissipated, last.dissipated);
    account.least_viscous = std::min(account.least_viscous, last.viscous);
    const double missing = std::abs(work - last.energy - element.dissipated());
    if (!(missing <= account.missing)) account.missing = missing;  // nan stays
    if (std::isnan(missing)) return account;
  }
  account.viscous = element.viscous();
  account.resting = size_of(element.to(path.back(), dt).viscous_stress);
  return account;
}

double largest_part(const Tensor& t) {
  double largest = 0;
  for (const double part : t) {
    if (std::isnan(part)) return part;
    largest = std::max(largest, std::abs(part));
  }
  return largest;
}

/// Largest eigenvalue of a symmetric positive matrix, by powers.
double largest_eigenvalue(const double (&d)[9]) {
  double v[3] = {1, 0.7, 0.4}, size = 0;
  for (int round = 0; round < 200; ++round) {
    double next[3];
    for (int i = 0; i < 3; ++i) next[i] = d[3 * i] * v[0] + d[3 * i + 1] * v[1] + d[3 * i + 2] * v[2];
    size = std::sqrt(next[0] * next[0] + next[1] * next[1] + next[2] * next[2]);
    for (int i = 0; i < 3; ++i) v[i] = next[i] / size;
  }
  return size;
}

/// Stress xx, yy, xy per strain xx, yy, 2·xy from the undeformed state, Pa.
void measure_tangent(const Material& law, double (&d)[9]) {
  constexpr double step = 1e-7;
  const Tensor strained[] = {{1 + step, 0, 0, 1}, {1, 0, 0, 1 + step}, {1, step / 2, step / 2, 1}};
  for (std::size_t j = 0; j < 3; ++j) {
    const Tensor p = DrivenElement(law).to(strained[j], 0).stress;
    d[j] = p[0] / step, d[3 + j] = p[3] / step, d[6 + j] = (p[1] + p[2]) / (2 * step);
  }
}

/// s, viscous stress over elastic stress at a strain rate of 1 per second, as stress shows it that falls at
/// once where strain stands still. 0 where it does not: stress that relaxes needs longer.
double measured_viscous_time(const Material& law) {
  constexpr double dt = 1e-9;
  DrivenElement element(law);
  const Tensor strained{1 + 1e-7, 0, 0, 1};
  const double moving = element.to(strained, dt).stress[0], still = element.to(strained, dt).stress[0];
  const double time = std::abs((moving - still) / still) * dt;
  return std::isfinite(time) && time > dt ? time : 0;
}

void expect_power_booked(const Material& law, double strain, double period, Trial& trial) {
  const Account coarse = account_of(law, round_trip(strain, 400), period / 400),
                fine = account_of(law, round_trip(strain, 800), period / 800);
  trial.feed(fmt::format(
      "one round of strains of {:g} under a turn of as much within {:g} s, in 400 steps and in 800", strain,
      period));
  // What steps miss of the work gets smaller with them, at least as they do.
  const double allowed =
      std::max({0.6 * coarse.missing, 1e-8 * coarse.turned_over, round_off * modulus_of(law)});
  trial.at_most(coarse.missing, 1e-2 * coarse.turned_over,
                "largest |work − energy − dissipated| [J/m³] in 400 steps");
  trial.at_most(fine.missing, allowed, "largest |work − energy − dissipated| [J/m³] in 800 steps");
  trial.at_most(-coarse.least_dissipated, 1e-12 * coarse.turned_over, "energy dissipated below zero [J/m³]");
}

}  // namespace

Made<Material> sample_material(const Subject& subject, const Values& given) {
  const Component& component = *subject.component->component;
  return make<Material>(*subject.component,
                        in_order({component.parameters, component.parameter_count}, given));
}

double modulus_of(const Material& law) {
  constexpr double step = 1e-7;
  return std::abs(DrivenElement(law).to({1 + step, 0, 0, 1}, 0).stress[0]) / step;
}

void check_power(const Subject& subject, Trial& trial) {
  const auto law = sample_material(subject), damped = sample_material(subject, {{"damping_time", 2e-4}});
  // So fast that viscous stress takes half of the work and more.
  const double viscous_time = measured_viscous_time(*damped);
  for (const double strain : strains) {
    expect_power_booked(*law, strain, 0.4, trial);
    if (viscous_time > 0) expect_power_booked(*damped, strain, 10 * viscous_time, trial);
  }
}

void check_viscous_loss(const Subject& subject, Trial& trial) {
  const auto law = sample_material(subject, {{"damping_time", 2e-4}});
  for (const double strain : strains) {
    const std::vector<Tensor> path = round_trip(strain, 400);
    const Account quick = account_of(*law, path), slow = account_of(*law, path, 1e3);
    trial.feed(fmt::format(
        "one round of strains of {:g} under a turn of as much, in 400 steps of 1e-3 and of 1000 s", strain));
    const double rounding = 1e-12 * quick.turned_over;
    trial.due(std::isfinite(rounding), "stress that is no number", "finite numbers");
    trial.at_most(-quick.least_viscous, rounding,
                  "work of viscous stress over the step that made it, below zero [J/m³]");
    trial.at_most(quick.resting, round_off * modulus_of(*law), "viscous stress [Pa] at rest");
    trial.at_most(slow.viscous, 1e-5 * quick.viscous + 1e-12 * slow.turned_over,
                  "work of viscous stress in slow motion [J/m³]");
    if (measured_viscous_time(*law) > 0) {
      trial.due(quick.viscous > 0, fmt::format("work of viscous stress of {:g} J/m³", quick.viscous),
                "more than 0, for stress falls at once where strain stands still");
    }
  }
}

void check_objectivity(const Subject& subject, Trial& trial) {
  const auto law = sample_material(subject);
  const double modulus = modulus_of(*law);
  {
    trial.feed("a whole turn without strain, in 126 steps");
    DrivenElement element(*law);
    for (int i = 1; i <= 126; ++i) {
      const Response response = element.to(rotation(0.05 * i));
      trial.at_most(largest_part(response.stress), 1e-11 * modulus, "stress [Pa]");
      trial.at_most(std::abs(response.energy), 1e-14 * modulus, "energy [J/m³]");
    }
  }
  const std::vector<Tensor> path = lively_path(0.02, 200);
  const Tensor q = rotation(1.234);
  DrivenElement element(*law), turned(*law);
  turned.to(q);
  trial.feed("200 steps of strains of 0.02, and the same seen from a direction turned by 1.234 rad");
  for (const Tensor& f : path) {
    const Response one = element.to(f), two = turned.to(product(q, f));
    trial.at_most(largest_part(difference_of(two.stress, product(q, one.stress))), 1e-11 * modulus,
                  "stress [Pa] that is not the turned one");
    trial.at_most(std::abs(two.energy - one.energy), 1e-11 * modulus, "difference of energy [J/m³]");
    const Tensor kirchhoff = product(one.stress, transposed(f));
    trial.at_most(std::abs(kirchhoff[1] - kirchhoff[2]), 1e-11 * modulus,
                  "moment, P Fᵀ less its transpose [Pa]");
  }
  trial.feed("a strained element that spins by 0.05 rad per step, 126 steps");
  const Tensor deformed{1.002, 0.001, 0, 0.999};
  DrivenElement spinning(*law), still(*law);
  spinning.along(deformed, 20);
  still.along(deformed, 20);
  for (int i = 1; i <= 126; ++i) {
    const Tensor r = rotation(0.05 * i), due = product(r, still.to(deformed).stress);  // it may relax
    trial.at_most(largest_part(difference_of(spinning.to(product(r, deformed)).stress, due)), 1e-9 * modulus,
                  "stress [Pa] that did not turn with the element");
  }
}

void check_stress_potential(const Subject& subject, Trial& trial) {
  if ((subject.component->component->traits & trait::has_potential) == 0) {
    trial.not_claimed("trait::has_potential is not set");
    return;
  }
  const auto law = sample_material(subject);
  const double modulus = modulus_of(*law);
  for (const double strain : strains) {
    const double step = 1e-3 * strain;
    for (const Tensor& f : lively_path(strain, 40, 0.1)) {
      trial.feed(fmt::format("F = [{:.9g}, {:.9g}; {:.9g}, {:.9g}] from the undeformed state", f[0], f[1],
                             f[2], f[3]));
      DrivenElement element(*law);
      element.to(f);
      const Tensor stress = element.to(f).stress;  // at rest, without viscous stress
      for (std::size_t k = 0; k < 4; ++k) {
        const auto energy = [&](double change) {
          Tensor moved = f;
          moved[k] += change;
          return DrivenElement(*law).to(moved).energy;
        };
        // Fourth order, so that the differences are good to 1e-7.
        const double slope =
            (8 * (energy(step) - energy(-step)) - (energy(2 * step) - energy(-2 * step))) / (12 * step);
        trial.at_most(std::abs(stress[k] - slope), 1e-6 * size_of(stress) + round_off * modulus / step,
                      fmt::format("|P − dW/dF| of component {}, where P is {:.9g} Pa", k, stress[k]));
      }
    }
  }
}

void check_tangent(const Subject& subject, Trial& trial) {
  const auto law = sample_material(subject);
  double declared[9], found[9];
  law->stiffest_tangent(declared);
  measure_tangent(*law, found);
  const double stiffest = largest_eigenvalue(declared), measured = largest_eigenvalue(found);
  trial.feed("strains of 1e-7 from the undeformed state");
  trial.at_most(measured, 1.001 * stiffest, "measured stiffness of the fastest wave, ρ c² [Pa]");
  trial.at_most(
      stiffest, 100 * measured,
      fmt::format("declared stiffness of the fastest wave, ρ c² [Pa], where {:.9g} is measured", measured));
  for (const int k : {0, 4, 8})
    trial.due(declared[k] > 0, fmt::format("{:.9g} Pa on the diagonal of the declared tangent", declared[k]),
              "more than 0");
  for (int k : {1, 2, 5}) {
    trial.at_most(std::abs(declared[k] - declared[k == 1   ? 3
                                                  : k == 2 ? 6
                                                           : 7]),
                  1e-9 * stiffest, "declared tangent less its transpose [Pa]");
  }
  DrivenElement element(*law);
  for (const Tensor& f : lively_path(0.02, 40, 0.05)) {
    element.to(f);
    for (std::size_t k = 0; k < 4; ++k) {
      constexpr double step = 1e-6;
      DrivenElement here = element, moved = element;
      Tensor g = f;
      g[k] += step;
      const Tensor change = difference_of(moved.to(g, 0).stress, here.to(f, 0).stress);
      trial.feed(fmt::format("F = [{:.9g}, {:.9g}; {:.9g}, {:.9g}], component {} more by 1e-6", f[0], f[1],
                             f[2], f[3], k));
      // Strains of 0.02 change what a tangent is measured in by a few per cent.
      trial.at_most(size_of(change) / step, 1.2 * stiffest, "stress per strain [Pa]");
    }
  }
  const auto viscous = sample_material(subject, {{"damping_time", 2e-4}});
  trial.feed("nothing but damping_time 2e-4 s where there is one");
  trial.due(std::isfinite(viscous->viscous_time()) && viscous->viscous_time() >= 0,
            fmt::format("a viscous time of {} s", viscous->viscous_time()), "a finite number from 0 on");
  trial.feed("a strain of 1e-7 within 1 ms and at rest, damping_time 2e-4 s where there is one");
  const Tensor strained{1 + 1e-7, 0, 0, 1};
  const double damped = DrivenElement(*viscous).to(strained, 1e-3).stress[0];
  const double plain = DrivenElement(*viscous).to(strained, 0).stress[0];
  trial.at_most((damped - plain) / plain * 1e-3, 1.001 * viscous->viscous_time() + 1e-12,
                "measured viscous time [s]");
}

}  // namespace talus::conformance
