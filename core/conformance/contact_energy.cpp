#include "conformance/contact_energy.hpp"

#include "conformance/boundary_arrays.hpp"
#include "conformance/contact_setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

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

/// Follows a path with the upper body and adds up what is put in and what is booked, J/m.
struct Path {
  DrivenLaw& law;
  double work = 0, booked = 0, stored = 0, turned_over = 0, way = 0;
  double blurred = 0;  ///< J/m, what the trapezoids may be off where forces jump
  double dt;           ///< s
  Evaluation last;

  explicit Path(DrivenLaw& given, double step = 1e-4) : law(given), dt(step) {
    last = law.step(dt), stored = last.pairs[0].stored;
  }

  /// To u in straight steps.
  void go(Vec2 to, int steps = 400) {
    HeldBody& body = law.bodies[1];
    const Vec2 from = body.motion.u;
    for (int i = 0; i < steps; ++i) {
      const Vec2 d{(to.x - from.x) / steps, (to.y - from.y) / steps};
      body.motion.velocity = {d.x / dt, d.y / dt};
      const Vec2 before = last.on(1);
      last = law.step(dt);
      const Vec2 now = last.on(1);
      const double part = -dot({before.x + now.x, before.y + now.y}, d) / 2;
      work += part;
      blurred += std::abs(dot({now.x - before.x, now.y - before.y}, d)) / 2;
      turned_over += std::abs(part);
      way += size_of(d);
      booked += last.pairs[0].slip_loss + last.pairs[0].damping_power;
    }
  }

  double gain() const { return last.pairs[0].stored - stored; }
};

struct Setup {
  const char* name;
  std::vector<HeldBody> bodies;
};

std::vector<Setup> setups() {
  return {{"a block 1 mm deep in a base", flat_on_flat()},
          {"a corner of 60 degrees 2 mm deep in a side", corner_in_flat()}};
}

Values with_friction(double angle) {
  return with(undamped_interface(), {{"friction_angle", angle},
                                     {"friction_coefficient", std::tan(angle * std::numbers::pi / 180)}});
}

/// What a contact has stored is there as it ends and begins, too.
void expect_parting_booked(const Subject& subject, Trial& trial) {
  for (const Setup& setup : setups()) {
    trial.feed(fmt::format(
        "{}, friction angle 25 degrees, undamped, sheared, lifted off by 3 mm and put back", setup.name));
    DrivenLaw law(*subject.component, with_friction(25));
    law.bodies = setup.bodies;
    Path path(law);
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
      with(with_friction(25),
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
      Path path(law);
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

void check_account(const Subject& subject, Trial& trial) {
  for (const Setup& setup : setups()) {
    for (const auto& [angle, dt] : {std::pair{0.0, 1e-4}, {5.0, 1e-4}, {25.0, 1e-4}, {25.0, 5e-4}}) {
      trial.feed(
          fmt::format("{}, friction angle {:g} degrees, undamped, led along five legs and back in "
                      "steps of {:g} ms",
                      setup.name, angle, 1e3 * dt));
      DrivenLaw law(*subject.component, with_friction(angle));
      law.bodies = setup.bodies;
      Path path(law, dt);
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
  const double rounded = 1e-15 * scale_of(subject);
  for (const Setup& setup : setups()) {
    for (const Cycle& cycle : cycles) {
      DrivenLaw law(*subject.component, with_friction(cycle.angle));
      law.bodies = setup.bodies;
      Path path(law);
      for (int round = 1; round <= 2; ++round) {
        trial.feed(fmt::format("{}, {}, friction angle {:g} degrees, undamped, round {}", setup.name,
                               cycle.name, cycle.angle, round));
        for (const Vec2 to : cycle.legs) path.go(to, 200);
        trial.at_most(
            -path.work, 2e-5 * path.turned_over + rounded * path.way,
            fmt::format("energy won [J/m] in {} rounds, of {:.9g} turned over", round, path.turned_over));
      }
    }
  }
}

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
