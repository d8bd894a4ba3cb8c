#include "conformance/contact_energy.hpp"

#include "conformance/contact_setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace talus::conformance {
namespace {

/// A small angle, about a point given relative to the centre, of a body that has not moved.
void turn_about(HeldBody& body, Vec2 at, double angle) {
  body.motion.h = {0, -angle, angle, 0};
  body.motion.u = {angle * at.y, -angle * at.x};
}

/// Force along `direction` per way of the upper body, N/m per m, between two depths.
struct Measured {
  double normal, tangential, damping;
  double rocking;    ///< N m per rad and metre, about the middle of the contact
  double stretched;  ///< the same of springs along it, per strain
  double rounded;    ///< what round-off makes of nothing
};

Measured measured(const Subject& subject, double width, double depth) {
  const std::vector<HeldBody> bodies{box(-2 * width, -width, 2 * width, 0),
                                     box(-width / 2, -depth, width / 2, width)};
  DrivenLaw law(*subject.component, undamped_interface());
  law.bodies = bodies;
  const double step = 1e-3 * depth, dt = 1e-4;
  const double here = law.look().on(1).y;
  law.bodies[1].motion.u.y -= step;
  const double deeper = law.look().on(1).y;
  law.bodies = bodies;
  const Vec2 foot = bodies[1].reference_of({0, -depth});
  const double level = law.look().moment_on(1, foot);
  turn_about(law.bodies[1], foot, step / width);
  const double rocking = (level - law.look().moment_on(1, foot)) / (step / width);
  law.bodies = bodies;
  law.step(dt);
  law.bodies[1].motion.velocity = {step / dt, 0};
  const double sheared = -law.step(dt).on(1).x;
  law.bodies = bodies;
  law.history.clear();
  const double loose = law.step(dt).forces[1].moment.xx;
  law.bodies[1].motion.rate.xx = step / width / dt;
  const double stretched = (loose - law.step(dt).forces[1].moment.xx) / (step / width);

  DrivenLaw damped(*subject.component, with(lively_interface(), {{"tangential_damping", 0}}));
  damped.bodies = bodies;
  const double still = damped.look(1e-9).on(1).y;
  constexpr double speed = 0.01;
  damped.bodies[1].motion.velocity = {0, -speed};
  return {(deeper - here) / step,
          sheared / step,
          (damped.look(1e-9).on(1).y - still) / speed,
          rocking,
          stretched,
          1e-15 * here / (depth * step)};
}

}  // namespace

void check_stiffness(const Subject& subject, Trial& trial) {
  constexpr double order = 1e3, margin = 1.02, mass = 1000;
  for (const double width : {0.1, 1.0, 8.0}) {
    const double depth = 1e-3;
    const DrivenLaw law(*subject.component);
    // Each end of the side by itself, as the host asks.
    ContactStiffness declared = law.law().stiffness(law.prepared(lively_interface()).data(), width / 2);
    declared.normal *= 2;
    declared.tangential *= 2;
    const Measured found = measured(subject, width, depth);
    trial.feed(fmt::format("a side {:g} m long, {:g} m deep in a wide base; twice stiffness(…, {:g} m)",
                           width, depth, width / 2));
    // The ends of the block are immersed as well.
    const double allowed = margin + 4 * depth / width;
    trial.at_most(found.normal, allowed * declared.normal, "measured normal stiffness [N/m per m]");
    trial.at_most(
        declared.normal, order * found.normal,
        fmt::format("declared normal stiffness [N/m per m], where {:.9g} is measured", found.normal));
    const bool spread = (subject.component->component->traits & trait::spread_springs) != 0;
    const double lever = width * width / (spread ? 12 : 4);
    trial.at_most(found.rocking, allowed * declared.normal * lever,
                  "measured stiffness against rocking [N m per rad and metre]");
    trial.at_most(found.tangential, allowed * declared.tangential + found.rounded,
                  "measured tangential stiffness [N/m per m]");
    if (found.tangential > found.rounded) {
      trial.at_most(found.stretched,
                    allowed * (declared.tangential + 4 * depth / width * found.normal) * lever,
                    "measured stiffness along a contact that is stretched [N m per strain and metre]");
      trial.at_most(declared.tangential, order * found.tangential,
                    fmt::format("declared tangential stiffness [N/m per m], where {:.9g} is measured",
                                found.tangential));
    }
    const double critical = 2 * std::sqrt(std::max(0.0, found.normal) * mass);
    trial.at_most(found.damping / critical, allowed * declared.normal_damping_ratio + 1e-4,
                  "measured damping across the contact, share of critical");
    trial.due(declared.tangential_damping_ratio >= 0,
              fmt::format("a declared tangential damping ratio of {:g}", declared.tangential_damping_ratio),
              "0 or more");
  }
}

}  // namespace talus::conformance
