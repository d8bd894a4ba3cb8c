#include "conformance/boundary_arrays.hpp"
#include "conformance/contact_energy.hpp"
#include "conformance/contact_setup.hpp"
#include "conformance/driven_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus::conformance {
namespace {

/// m/s, by which corners of the two bodies differ at most.
double fastest_approach(const std::vector<HeldBody>& bodies) {
  const BoundaryArrays arrays(bodies);
  double most = 0;
  for (std::size_t i = 0; i < arrays.corners.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (arrays.corner_body[i] == arrays.corner_body[j]) continue;
      const BoundaryCorner &p = arrays.corners[i], &q = arrays.corners[j];
      most = std::max(most, size_of({p.vx - q.vx, p.vy - q.vy}));
    }
  }
  return most;
}

/// Power is force times what moves it, and nothing between two bodies moves faster than their corners do.
void expect_power_of_force(const DrivenLaw& law, const PairReport& report, double dt, Trial& trial) {
  trial.at_most(-report.damping_power, 0, "energy that dashpots give back [J/m]");
  if (report.damping_power == 0) return;
  trial.at_most(
      report.damping_power / (fastest_approach(law.bodies) * dt), (1 + 1e-6) * report.damping_force,
      "damping_power over the largest displacement between the bodies, against damping_force [N/m]");
}

/// What differs from the same place without dashpots is theirs, and what friction bears more or less where
/// they press: up to half of that once more.
void expect_force_told(const Evaluation& damped, const Evaluation& undamped, Trial& trial) {
  const Vec2 difference = damped.on(1) - undamped.on(1);
  if (size_of(difference) <= 1e-9 * undamped.size()) return;
  trial.at_most(size_of(difference) / 1.5, damped.pairs[0].damping_force,
                "two thirds of what dashpots add to the force on body 1 [N/m], against damping_force");
}

/// Swung through one period, at rest in the beginning and in the end: what is put in is what dashpots and
/// friction took.
struct Swing {
  const char* name;
  Vec2 size;  ///< m
};
constexpr Swing swings[] = {
    {"across the contact", {0, 5e-4}}, {"along it, in stick", {1e-4, 0}}, {"both ways", {1e-4, 5e-4}}};

void expect_swing_booked(const Subject& subject, const Setup& setup, const Swing& swing, double share,
                         double rounded, Trial& trial) {
  constexpr int steps = 400;
  constexpr double period = 2e-3;  // s
  trial.feed(
      fmt::format("{}, damped, swung {} by ({:g}, {:g}) m once within {:g} s, in {} steps, master "
                  "share {:g}",
                  setup.name, swing.name, swing.size.x, swing.size.y, period, steps, share));
  DrivenLaw law(*subject.component);
  law.bodies = setup.bodies;
  law.master_share = share;
  DrivenPath path(law, period / steps);
  const auto at = [&](int step) {
    const double deep = (1 - std::cos(2 * std::numbers::pi * step / steps)) / 2;
    return Vec2{deep * swing.size.x, -deep * swing.size.y};
  };
  for (int step = 1; step <= steps; ++step) path.take(at(step) - at(step - 1));
  // Friction that begins or ends to slip takes a dashpot away or brings it within a step: first order.
  trial.at_most(std::abs(path.work - path.gain() - path.booked()),
                2e-5 * path.turned_over + path.damped / steps + rounded * path.way,
                fmt::format("|work − (stored + lost)| [J/m], where work is {:.9g}, stored {:.9g}, lost "
                            "{:.9g} by friction and {:.9g} by dashpots",
                            path.work, path.gain(), path.lost_in_slip, path.damped));
}

}  // namespace

void expect_dashpots_booked(const Subject& subject, Trial& trial) {
  constexpr double dt = 1e-4;
  for (const HeldPair& pair : random_pairs(36)) {
    trial.feed(fed_pair(pair, 0.5) + ", moving, damped");
    DrivenLaw law(*subject.component), undamped(*subject.component, undamped_interface());
    law.bodies = pair.bodies;
    for (int step = 0; step < 3; ++step) {
      undamped.bodies = law.bodies;
      undamped.history = law.history;
      const Evaluation e = law.step(dt);
      expect_power_of_force(law, e.pairs[0], dt, trial);
      expect_force_told(e, undamped.step(dt), trial);
    }
  }
  const double rounded = 1e-15 * scale_of(subject, trial);
  for (const Setup& setup : setups()) {
    for (const Swing& swing : swings) {
      for (const double share : {0.0, 0.5, 1.0})
        expect_swing_booked(subject, setup, swing, share, rounded, trial);
    }
  }
}

}  // namespace talus::conformance
