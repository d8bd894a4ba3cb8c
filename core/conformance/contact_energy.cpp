#include "conformance/contact_energy.hpp"

#include "conformance/contact_setup.hpp"
#include "conformance/driven_path.hpp"

#include <fmt/format.h>

#include <cmath>

namespace talus::conformance {
namespace {

/// One generalised coordinate of a body: a component of u or of H.
struct Coordinate {
  const char* name;
  double Vec2::*shift;
  double Matrix2::*gradient;
};
constexpr Coordinate coordinates[] = {{"u_x", &Vec2::x, nullptr},      {"u_y", &Vec2::y, nullptr},
                                      {"H_xx", nullptr, &Matrix2::xx}, {"H_xy", nullptr, &Matrix2::xy},
                                      {"H_yx", nullptr, &Matrix2::yx}, {"H_yy", nullptr, &Matrix2::yy}};

double& value_of(HeldBody& body, const Coordinate& q) {
  return q.shift != nullptr ? body.motion.u.*q.shift : body.motion.h.*q.gradient;
}

double force_of(const BodyForce& force, const Coordinate& q) {
  return q.shift != nullptr ? force.force.*q.shift : force.moment.*q.gradient;
}

void expect_derivative(Trial& trial, DrivenLaw& law, const HeldPair& pair) {
  const Evaluation here = law.look();
  const double step = 1e-5 * pair.depth;
  for (std::size_t body = 0; body < 2; ++body) {
    for (const Coordinate& q : coordinates) {
      double& value = value_of(law.bodies[body], q);
      const double start = value;
      value = start + step;
      const double ahead = law.look().pairs[0].stored;
      value = start - step;
      const double behind = law.look().pairs[0].stored;
      value = start;
      const double force = force_of(here.forces[body], q), due = -(ahead - behind) / (2 * step);
      trial.at_most(
          std::abs(force - due), 1e-6 * here.size(),
          fmt::format("|force + dstored/dq| for {} of body {}, where the force is {:.9g} and the energy "
                      "makes {:.9g}",
                      q.name, body, force, due));
    }
  }
}

}  // namespace

void check_potential(const Subject& subject, Trial& trial) {
  if ((subject.component->component->traits & trait::has_potential) == 0) {
    trial.not_claimed("trait::has_potential is not set");
    return;
  }
  std::vector<HeldPair> pairs = random_pairs(36);
  for (const double degrees : {3.0, 40.0}) pairs.push_back(chamfered(0.01, degrees, 4e-3));
  pairs.push_back(saw_teeth(1e-3));
  pairs.push_back(body_in_notch(1e-3));
  for (const HeldPair& pair : pairs) {
    for (const double share : {0.0, 0.5, 1.0}) {
      trial.feed(fed_pair(pair, share) + ", at rest, without damping");
      DrivenLaw law(*subject.component, undamped_interface());
      law.bodies = pair.bodies;
      law.master_share = share;
      at_rest(law.bodies);
      expect_derivative(trial, law, pair);
    }
  }
}

void check_cycles(const Subject& subject, Trial& trial) {
  struct Cycle {
    const char* name;
    double angle;
    std::vector<Vec2> legs;
  };
  const Cycle cycles[] = {
      {"pressed deeper and let go", 25, {{0, -5e-4}, {0, 0}, {0, 5e-4}, {0, 0}}},
      {"sheared to and fro in stick", 89, {{1e-4, 0}, {-1e-4, 0}, {0, 0}}},
      {"sheared, unloaded in part, sheared back, loaded", 89, {{1e-4, 0}, {1e-4, 5e-4}, {0, 5e-4}, {0, 0}}},
      {"unloaded in part, sheared, loaded, sheared back", 89, {{0, 5e-4}, {1e-4, 5e-4}, {1e-4, 0}, {0, 0}}},
      {"slid to and fro", 25, {{2e-3, 0}, {-2e-3, 0}, {0, 0}}},
      {"slid round a square", 25, {{2e-3, 0}, {2e-3, 5e-4}, {-2e-3, 5e-4}, {-2e-3, 0}, {0, 0}}}};
  const double rounded = 1e-15 * scale_of(subject, trial);
  for (const Setup& setup : setups()) {
    for (const Cycle& cycle : cycles) {
      for (const double share : {0.0, 0.5, 1.0}) {
        DrivenLaw law(*subject.component, undamped_with_friction(cycle.angle));
        law.bodies = setup.bodies;
        law.master_share = share;
        DrivenPath path(law);
        for (int round = 1; round <= 2; ++round) {
          trial.feed(fmt::format("{}, {}, friction angle {:g} degrees, undamped, master share {:g}, round {}",
                                 setup.name, cycle.name, cycle.angle, share, round));
          for (const Vec2 to : cycle.legs) path.go(to, 200);
          trial.at_most(
              -path.work, 2e-5 * path.turned_over + rounded * path.way,
              fmt::format("energy won [J/m] in {} rounds, of {:.9g} turned over", round, path.turned_over));
        }
      }
    }
  }
}

}  // namespace talus::conformance
