#include "conformance/contact_energy.hpp"
#include "conformance/contact_setup.hpp"
#include "conformance/driven_path.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace talus::conformance {
namespace {

void expect_booked(const DrivenPath& path, double allowed, Trial& trial) {
  const double stored = path.last.pairs[0].stored;
  trial.due(std::isfinite(path.turned_over), "forces along the way that are no numbers", "finite numbers");
  trial.due(stored >= -1e-9 * path.turned_over, fmt::format("a stored energy of {:.9g} J/m", stored),
            "0 or more");
  trial.at_most(path.given_by_slip, 5 * allowed, "slip losses below zero, which give back, in sum [J/m]");
  trial.at_most(
      std::abs(path.work - path.gain() - path.booked()), allowed,
      fmt::format("|work − (stored + lost)| [J/m], where work is {:.9g}, stored {:.9g}, lost {:.9g}",
                  path.work, path.gain(), path.booked()));
}

void expect_legs_booked(const Subject& subject, const Setup& setup, double angle, double dt, double share,
                        Trial& trial) {
  trial.feed(
      fmt::format("{}, friction angle {:g} degrees, undamped, master share {:g}, led along five legs and "
                  "back in steps of {:g} ms",
                  setup.name, angle, share, 1e3 * dt));
  DrivenLaw law(*subject.component, undamped_with_friction(angle));
  law.bodies = setup.bodies;
  law.master_share = share;
  DrivenPath path(law, dt);
  for (const Vec2 to : {Vec2{2e-4, 0}, {2e-4, 5e-4}, {-8e-4, 5e-4}, {-8e-4, -5e-4}, {5e-4, -2e-4}, {0, 0}})
    path.go(to);
  // Work is summed by trapezoids of 400 steps per leg: an error of second order.
  expect_booked(path, 2e-5 * (std::abs(path.work) + path.stored), trial);
}

/// What a contact has stored is there as it ends and begins, too.
void expect_parting_booked(const Subject& subject, const Setup& setup, double share, Trial& trial) {
  trial.feed(
      fmt::format("{}, friction angle 25 degrees, undamped, master share {:g}, sheared, lifted off by "
                  "3 mm and put back",
                  setup.name, share));
  DrivenLaw law(*subject.component, undamped_with_friction(25));
  law.bodies = setup.bodies;
  law.master_share = share;
  DrivenPath path(law);
  for (const Vec2 to : {Vec2{1e-4, 0}, {1e-4, 3e-3}, {1e-4, 0}}) {
    path.go(to, 2000);
    expect_booked(path, 2e-5 * (path.turned_over + path.stored) + path.blurred, trial);
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
      expect_booked(path, 2e-5 * (path.turned_over + path.stored) + path.blurred, trial);
    }
  }
}

}  // namespace

void check_account(const Subject& subject, Trial& trial) {
  for (const Setup& setup : setups()) {
    for (const auto& [angle, dt] : {std::pair{0.0, 1e-4}, {5.0, 1e-4}, {25.0, 1e-4}, {25.0, 5e-4}})
      expect_legs_booked(subject, setup, angle, dt, 0.5, trial);
    for (const double share : {0.0, 1.0}) expect_legs_booked(subject, setup, 25, 1e-4, share, trial);
    for (const double share : {0.0, 0.5, 1.0}) expect_parting_booked(subject, setup, share, trial);
  }
  expect_bonds_booked(subject, trial);
  expect_dashpots_booked(subject, trial);
}

}  // namespace talus::conformance
