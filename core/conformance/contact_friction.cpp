#include "conformance/contact_forces.hpp"
#include "conformance/contact_setup.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace talus::conformance {
namespace {

/// As contacts that push tell it.
void expect_slipping(Trial& trial, const Evaluation& e, double due) {
  for (const ContactReport& contact : e.contacts) {
    if (contact.px == 0 && contact.py == 0) continue;
    trial.due(contact.slipping == due, fmt::format("slipping {:g} in a report", contact.slipping),
              due == 1 ? "1: it has slid on for 10 mm" : "0: friction is held");
  }
}

/// Of a block that slides over a base: its limit, nine tenths of it at least, and against the way it goes.
void expect_sliding(Trial& trial, const Subject& subject, const Values& interface, double mu, double speed,
                    double share, double rounded) {
  trial.feed(
      fmt::format("a block 1 mm deep in a base slides at {:g} m/s, friction {:g} (angle {:g} degrees), "
                  "master share {:g}, 20 steps of 0.5 ms",
                  speed, mu, std::atan(mu) * 180 / std::numbers::pi, share));
  DrivenLaw law(*subject.component, interface);
  law.bodies = flat_on_flat();
  law.bodies[1].motion.velocity = {speed, 0};
  law.master_share = share;
  double against = 0, pressed = 0;
  Evaluation last;
  for (int step = 0; step < 20; ++step) {
    last = law.step(5e-4);
    const Vec2 force = last.on(1);
    against = -std::copysign(1, speed) * force.x, pressed = force.y;
    const double none = 1e-9 * pressed + rounded;
    // Both ends of the block are immersed by 1 mm of 1 m and count with their share.
    trial.at_most(std::abs(force.x), 1.01 * mu * pressed + none, "force along the base [N/m]");
    trial.at_most(-against, none, "force along the base [N/m] that drives the block on");
  }
  // After 10 mm and more at 1 m/s and more all springs have reached their limit, and what grows with the
  // speed its end.
  if (std::abs(speed) < 1) return;
  trial.at_most(0.9 * mu * pressed - against, rounded,
                "what the force against sliding lacks of nine tenths of μ P [N/m]");
  if (mu > 0) expect_slipping(trial, last, 1);
}

/// No limit applies while a scene settles with friction held.
void expect_held(Trial& trial, const Subject& subject, const Values& interface, double mu, double share) {
  trial.feed(
      fmt::format("a block 1 mm deep in a base slides at 1 m/s, friction {:g}, master share {:g}, "
                  "hold_stick, 40 steps of 0.5 ms",
                  mu, share));
  DrivenLaw law(*subject.component, interface);
  law.bodies = flat_on_flat();
  law.bodies[1].motion.velocity = {1, 0};
  law.master_share = share;
  law.hold_stick = true;
  Evaluation e;
  for (int step = 0; step < 40; ++step) e = law.step(5e-4);
  trial.at_most(1.5 * mu * e.on(1).y, -e.on(1).x,
                "one and a half of μ P [N/m], which the force against sliding goes beyond");
  expect_slipping(trial, e, 0);
}

/// With the flat as master all loads push one way, and the resultant is their sum.
void expect_reports_within_limit(Trial& trial, const Subject& subject, const Values& interface, double mu,
                                 double rounded) {
  for (const HeldPair& pair : random_pairs(36)) {
    if (pair.name.find("corner on flat") == std::string::npos) continue;
    trial.feed(fmt::format("{}, moving, friction {:g}", fed_pair(pair, 1), mu));
    DrivenLaw law(*subject.component, interface);
    law.bodies = pair.bodies;
    law.master_share = 1;
    for (int step = 0; step < 4; ++step) {
      for (const ContactReport& contact : law.step(5e-4).contacts) {
        trial.at_most(std::hypot(contact.tx, contact.ty),
                      mu * std::hypot(contact.px, contact.py) * (1 + 1e-9) + rounded,
                      "reported tangential force [N/m]");
      }
    }
  }
}

}  // namespace

void check_friction_limit(const Subject& subject, Trial& trial) {
  if (!has_interface_parameter(subject, "friction_angle") &&
      !has_interface_parameter(subject, "friction_coefficient")) {
    trial.not_claimed("no interface parameter friction_angle or friction_coefficient");
    return;
  }
  const double rounded = 1e-15 * scale_of(subject, trial);
  for (const double angle : {0.0, 5.0, 25.0, 45.0}) {
    const double mu = std::tan(angle * std::numbers::pi / 180);
    const Values interface = with(
        lively_interface(),
        {{"friction_angle", angle}, {"friction_coefficient", mu}, {"cohesion", 0}, {"tensile_strength", 0}});
    for (const double share : {0.0, 0.5, 1.0}) {
      for (const double speed : {0.05, 1.0, -5.0})
        expect_sliding(trial, subject, interface, mu, speed, share, rounded);
      if (mu > 0) expect_held(trial, subject, interface, mu, share);
    }
    expect_reports_within_limit(trial, subject, interface, mu, rounded);
  }
}

}  // namespace talus::conformance
