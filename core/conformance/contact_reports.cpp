#include "conformance/contact_forces.hpp"
#include "conformance/contact_setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace talus::conformance {
namespace {

/// Laws measure a penetration at a corner, or as a mean along the contact.
constexpr double least_share = 0.4, largest_share = 1.1;

void expect_depth(Trial& trial, double found, double depth, const char* of) {
  trial.due(found >= least_share * depth && found <= largest_share * depth,
            fmt::format("a penetration of {:.9g} m in the report of the {}", found, of),
            fmt::format("{:g} to {:g} m, for the overlap is {:g} m deep: the host stops a run by it",
                        least_share * depth, largest_share * depth, depth));
}

/// Σ over the contacts of the first pair, on body b, and its moment about the centre of body a.
struct Reported {
  Vec2 force;
  double moment = 0;
};
Reported reported(const Evaluation& e) {
  Reported sum;
  for (const ContactReport& contact : e.contacts) {
    const Vec2 force{contact.px + contact.tx, contact.py + contact.ty};
    sum.force += force;
    sum.moment += contact.moment + cross({contact.x, contact.y}, force);
  }
  return sum;
}

}  // namespace

void check_reports(const Subject& subject, Trial& trial) {
  for (const double depth : {1e-4, 1e-3, 0.02}) {
    for (const bool corner : {false, true}) {
      for (const double share : {0.5, 1.0}) {
        trial.feed(fmt::format("a {} {:g} m deep in a base, at rest, master share {:g}",
                               corner ? "corner of 60 degrees" : "block", depth, share));
        DrivenLaw law(*subject.component);
        law.bodies = corner ? corner_in_flat() : flat_on_flat();
        law.bodies[1].motion.u.y += (corner ? 2e-3 : 1e-3) - depth;
        law.master_share = share;
        law.step();
        const Evaluation e = law.step();
        if (e.size() == 0) continue;  // a law need not see every overlap
        expect_depth(trial, e.pairs[0].penetration, depth, "pair");
        double deepest = 0;
        for (const ContactReport& contact : e.contacts) deepest = std::max(deepest, contact.penetration);
        expect_depth(trial, deepest, depth, "deepest contact");
      }
    }
  }
  const double rounded = 1e-15 * scale_of(subject, trial);
  for (const HeldPair& pair : pairs_without_ties(36)) {
    for (const double share : {0.0, 0.5, 1.0}) {
      trial.feed(fed_pair(pair, share) + ", moving, the second step");
      DrivenLaw law(*subject.component);
      law.bodies = pair.bodies;
      law.master_share = share;
      law.step();
      const Evaluation e = law.step();
      const Reported said = reported(e);
      const Vec2 due = e.on(1);
      trial.at_most(size_of(said.force - due), 1e-6 * e.size() + rounded,
                    "sum of the reported forces less that of the loads on body b [N/m]");
      double due_moment = 0;
      for (const LoadedCorner& load : e.corners) {
        if (load.body == 1) due_moment += cross(load.at - law.bodies[0].centre, load.force);
      }
      // Bodies are some metres large.
      trial.at_most(std::abs(said.moment - due_moment), 1e-6 * e.size() + rounded,
                    "moment of the reported forces and moments less that of the loads on body b [N]");
      for (const ContactReport& contact : e.contacts) {
        trial.due(contact.slipping == 0 || contact.slipping == 1,
                  fmt::format("slipping {:g} in a report", contact.slipping), "0 or 1");
      }
    }
  }
}

}  // namespace talus::conformance
