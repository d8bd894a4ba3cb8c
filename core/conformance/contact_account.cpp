#include "conformance/boundary_arrays.hpp"
#include "conformance/contact_energy.hpp"
#include "conformance/contact_setup.hpp"
#include "conformance/driven_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace talus::conformance {
namespace {

/// What a contact has stored is there as it ends and begins, too.
void expect_parting_booked(const Subject& subject, Trial& trial) {
  for (const Setup& setup : setups()) {
    trial.feed(fmt::format(
        "{}, friction angle 25 degrees, undamped, sheared, lifted off by 3 mm and put back", setup.name));
    DrivenLaw law(*subject.component, undamped_with_friction(25));
    law.bodies = setup.bodies;
    DrivenPath path(law);
    for (const Vec2 to : {Vec2{1e-4, 0}, {1e-4, 3e-3}, {1e-4, 0}}) {
      path.go(to, 2000);
      trial.at_most(
          std::abs(path.work - path.gain() - path.booked),
          2e-5 * (path.turned_over + path.stored) + path.blurred,
          fmt::format("|work − (stored + lost)| [J/m], where work is {:.9g}, stored {:.9g}, lost {:.9g}",
                      path.work, path.gain(), path.booked));
    }
  }
}

/// Bonds that form while bodies touch, and break.
void expect_bonds_booked(const Subject& subject, Trial& trial) {
  const Values bonded =
      with(undamped_with_friction(25),
           {{"cohesion", 2e5}, {"tensile_strength", 1e5}, {"softening_opening", 0}, {"softening_slip", 0}});
  const std::vector<std::vector<Vec2>> ways{{{0, 5e-4}, {0, 0}}, {{5e-4, 0}, {-5e-4, 0}}, {{2e-4, 3e-4}}};
  for (const double depth : {0.0, 1e-3}) {
    for (const std::vector<Vec2>& way : ways) {
      trial.feed(
          fmt::format("a block {:g} mm deep in a base, bonds form where the law has any, led over "
                      "({:g}, {:g}) m",
                      1e3 * depth, way[0].x, way[0].y));
      DrivenLaw law(*subject.component, bonded);
      law.bodies = {box(-2, -1, 2, 0), box(-0.5, -depth, 0.5, 1)};
      law.bonds_form = true;
      DrivenPath path(law);
      law.bonds_form = false;
      for (const Vec2 to : way) path.go(to, 2000);
      trial.at_most(
          std::abs(path.work - path.gain() - path.booked),
          2e-5 * (path.turned_over + path.stored) + path.blurred,
          fmt::format("|work − (stored + lost)| [J/m], where work is {:.9g}, stored {:.9g}, lost {:.9g}",
                      path.work, path.gain(), path.booked));
    }
  }
}

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
void expect_dashpots_told(const DrivenLaw& law, const PairReport& report, double dt, Trial& trial) {
  trial.at_most(-report.damping_power, 0, "energy that dashpots give back [J/m]");
  if (report.damping_power == 0) return;
  trial.at_most(
      report.damping_power / (fastest_approach(law.bodies) * dt), (1 + 1e-6) * report.damping_force,
      "damping_power over the largest displacement between the bodies, against damping_force [N/m]");
}

}  // namespace

void check_account(const Subject& subject, Trial& trial) {
  for (const Setup& setup : setups()) {
    for (const auto& [angle, dt] : {std::pair{0.0, 1e-4}, {5.0, 1e-4}, {25.0, 1e-4}, {25.0, 5e-4}}) {
      trial.feed(
          fmt::format("{}, friction angle {:g} degrees, undamped, led along five legs and back in "
                      "steps of {:g} ms",
                      setup.name, angle, 1e3 * dt));
      DrivenLaw law(*subject.component, undamped_with_friction(angle));
      law.bodies = setup.bodies;
      DrivenPath path(law, dt);
      for (const Vec2 to :
           {Vec2{2e-4, 0}, {2e-4, 5e-4}, {-8e-4, 5e-4}, {-8e-4, -5e-4}, {5e-4, -2e-4}, {0, 0}})
        path.go(to);
      // Work is summed by trapezoids of 400 steps per leg: an error of second order.
      const double turned_over = std::abs(path.work) + path.stored;
      trial.at_most(
          std::abs(path.work - path.gain() - path.booked), 2e-5 * turned_over,
          fmt::format("|work − (stored + lost)| [J/m], where work is {:.9g}, stored {:.9g}, lost {:.9g}",
                      path.work, path.gain(), path.booked));
    }
  }
  expect_parting_booked(subject, trial);
  expect_bonds_booked(subject, trial);
  for (const HeldPair& pair : random_pairs(36)) {
    trial.feed(fed_pair(pair, 0.5) + ", moving, damped");
    DrivenLaw law(*subject.component);
    law.bodies = pair.bodies;
    for (int step = 0; step < 3; ++step) {
      constexpr double dt = 1e-4;
      expect_dashpots_told(law, law.step(dt).pairs[0], dt, trial);
    }
  }
}

}  // namespace talus::conformance
