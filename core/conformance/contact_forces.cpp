#include "conformance/contact_forces.hpp"

#include "conformance/contact_setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace talus::conformance {
namespace {

/// What a coordinate of these sizes may be off, m, when a scene is moved.
constexpr double moved_coordinate = 2e-15;
constexpr double relative_rounding = 1e-11;

/// Two steps, so that history and increments count.
Evaluation after_two_steps(const Subject& subject, const std::vector<HeldBody>& bodies, double share) {
  DrivenLaw law(*subject.component);
  law.bodies = bodies;
  law.master_share = share;
  law.step();
  return law.step();
}

void expect_same(Trial& trial, const Evaluation& here, const Evaluation& there, const Isometry& isometry,
                 double allowed) {
  for (std::size_t body = 0; body < 2; ++body) {
    trial.at_most(difference(moved(isometry, here.forces[body]), there.forces[body]), allowed,
                  fmt::format("difference of force [N/m] or moment [N] on body {}", body));
  }
  const double stored = here.pairs[0].stored;
  trial.at_most(std::abs(stored - there.pairs[0].stored), 1e-10 * std::abs(stored) + 1e-14,
                "difference of the stored energy [J/m]");
}

void check_moved(const Subject& subject, Trial& trial, const Isometry& isometry, const char* how) {
  const double scale = scale_of(subject, trial);
  for (const HeldPair& pair : pairs_without_ties(36)) {
    for (const double share : {0.5, 1.0}) {
      trial.feed(fed_pair(pair, share) + how);
      const std::vector<HeldBody> there{moved(isometry, pair.bodies[0]), moved(isometry, pair.bodies[1])};
      const Evaluation here = after_two_steps(subject, pair.bodies, share);
      expect_same(trial, here, after_two_steps(subject, there, share), isometry,
                  relative_rounding * here.size() + moved_coordinate * scale);
    }
  }
}

/// A corner that points down at 45 degrees, `gap` above the top of a base.
std::vector<HeldBody> corner_above(double gap) {
  std::vector<HeldBody> bodies{box(-1, -1, 1, 0), moved(turned_by(45), box(-0.5, -0.5, 0.5, 0.5))};
  bodies[1].centre = {0.1, std::sqrt(0.5) + gap};
  return bodies;
}

}  // namespace

void check_balance(const Subject& subject, Trial& trial) {
  const double rounded = 1e-15 * scale_of(subject, trial);
  std::vector<HeldPair> pairs = random_pairs(36);
  for (HeldPair& pair : awkward_pairs()) pairs.push_back(std::move(pair));
  std::size_t loaded = 0;
  for (const HeldPair& pair : pairs) {
    for (const double share : {0.0, 0.5, 1.0}) {
      const bool settles = share == 1;
      trial.feed(fed_pair(pair, share) + (settles ? ", moving, hold_stick and bonds_form" : ", moving"));
      DrivenLaw law(*subject.component);
      law.bodies = pair.bodies;
      law.master_share = share;
      law.hold_stick = law.bonds_form = settles;
      for (int step = 0; step < 3; ++step) {
        const Evaluation e = law.step();
        const double allowed = 1e-12 * e.size() + rounded;
        const Vec2 net = e.net_force();
        trial.at_most(std::hypot(net.x, net.y), allowed, "resultant of all loads [N/m]");
        trial.at_most(std::abs(e.net_moment()), allowed, "moment of all loads [N]");
        trial.due(std::isfinite(e.pairs[0].stored + e.pairs[0].slip_loss + e.pairs[0].damping_power),
                  "an energy that is no number", "finite stored, slip_loss and damping_power");
        if (e.size() > 0) ++loaded;
      }
    }
  }
  trial.feed("all pairs of this check, which overlap but for a few");
  trial.due(loaded > 50, fmt::format("loads in {} of {} evaluations", loaded, 9 * pairs.size()),
            "loads where bodies overlap");
}

void check_translation(const Subject& subject, Trial& trial) {
  // Both bodies are displaced alike, so that their corners have other coordinates; they are rounded by some
  // 1e-15 m there.
  const double scale = scale_of(subject, trial);
  for (const HeldPair& pair : pairs_without_ties(36)) {
    trial.feed(fed_pair(pair, 0.5) + ", both displaced by (8, -4) m");
    std::vector<HeldBody> there = pair.bodies;
    for (HeldBody& body : there) body.motion.u = {8, -4};
    const Evaluation here = after_two_steps(subject, pair.bodies, 0.5);
    expect_same(trial, here, after_two_steps(subject, there, 0.5), {},
                1e-10 * here.size() + 20 * moved_coordinate * scale);
  }
}

void check_rotation(const Subject& subject, Trial& trial) {
  check_moved(subject, trial, turned_by(37), ", turned by 37 degrees");
  check_moved(subject, trial, turned_by(90), ", turned by 90 degrees");
}

void check_reflection(const Subject& subject, Trial& trial) {
  check_moved(subject, trial, mirrored(), ", mirrored");
}

void check_order(const Subject& subject, Trial& trial) {
  const double scale = scale_of(subject, trial);
  for (const HeldPair& pair : pairs_without_ties(36)) {
    for (const double share : {0.0, 0.5, 1.0}) {
      trial.feed(fed_pair(pair, share) + ", and with the two bodies exchanged");
      const Evaluation here = after_two_steps(subject, pair.bodies, share);
      Evaluation there = after_two_steps(subject, {pair.bodies[1], pair.bodies[0]}, 1 - share);
      std::swap(there.forces[0], there.forces[1]);
      expect_same(trial, here, there, {}, relative_rounding * here.size() + moved_coordinate * scale);
    }
  }
}

void check_galilean(const Subject& subject, Trial& trial) {
  // A velocity of 8 m/s is itself rounded by 1e-15 m/s, and a dashpot is worth some 1e-3 s times the spring.
  // The faster bodies start so much further back that they are met at the same place.
  const double scale = scale_of(subject, trial);
  constexpr double dt = 1e-4;
  constexpr Vec2 boost{8, -4};
  for (const HeldPair& pair : pairs_without_ties(36)) {
    trial.feed(fed_pair(pair, 0.5) + ", both faster by (8, -4) m/s");
    DrivenLaw slow(*subject.component), fast(*subject.component);
    slow.bodies = fast.bodies = pair.bodies;
    slow.step(dt);
    fast.step(dt);
    for (HeldBody& body : fast.bodies) {
      body.motion.velocity += boost;
      body.motion.u = body.motion.u - dt * boost;
    }
    const Evaluation here = slow.step(dt);
    expect_same(trial, here, fast.step(dt), {},
                relative_rounding * here.size() + 4 * moved_coordinate * scale);
  }
}

void check_gap(const Subject& subject, Trial& trial) {
  const auto expect_nothing = [&](const std::string& fed, std::vector<HeldBody> bodies, double gap) {
    trial.feed(fed);
    HeldPair pair{"", std::move(bodies), 0};
    set_moving(pair, 3);
    DrivenLaw law(*subject.component);
    law.bodies = pair.bodies;
    const Evaluation e = law.look();
    trial.due(e.size() == 0, fmt::format("loads of {:.9g} N/m in sum", e.size()), "no load");
    trial.due(
        e.pairs[0].stored == 0 && e.pairs[0].penetration == 0,
        fmt::format("stored {:.9g} J/m, penetration {:.9g} m", e.pairs[0].stored, e.pairs[0].penetration),
        "0 of both");
    trial.due(e.pairs[0].gap >= 0, fmt::format("a gap of {:.9g} m", e.pairs[0].gap), "0 or more");
    trial.at_most(e.pairs[0].gap, gap + 1e-12,
                  "the gap [m] that the law reports, by which it may be left out");
  };
  for (const double gap : {0.0, 1e-9, 1e-4, 1e-3, 0.3}) {
    expect_nothing(fmt::format("a box {:g} m above another", gap),
                   {box(0, 0, 1, 1), box(0.25, 1 + gap, 1.25, 2 + gap)}, gap);
  }
  for (const double gap : {1e-9, 1e-4, 1e-3, 0.3}) {
    expect_nothing(fmt::format("a box {0:g} m above and {0:g} m beside another", gap),
                   {box(0, 0, 1, 1), box(1 + gap, 1 + gap, 2 + gap, 2 + gap)}, std::sqrt(2.0) * gap);
    expect_nothing(fmt::format("a corner {:g} m above a side", gap), corner_above(gap), gap);
  }
}

void check_tension(const Subject& subject, Trial& trial) {
  if ((subject.component->component->traits & trait::pulls) != 0) {
    trial.not_claimed("trait::pulls: bodies may pull at each other");
    return;
  }
  const Values without_bonds = with(lively_interface(), {{"cohesion", 0}, {"tensile_strength", 0}});
  const auto expect_no_pull = [&](std::vector<HeldBody> bodies, const std::string& fed) {
    DrivenLaw law(*subject.component, without_bonds);
    law.bodies = std::move(bodies);
    at_rest(law.bodies);
    const Vec2 still = law.look().on(1);
    const double square = dot(still, still), size = std::sqrt(square);
    if (size == 0) return;  // a law need not see every overlap
    const auto centre = [&](std::size_t body) {
      const HeldBody& at = law.bodies[body];
      return at.centre + at.motion.u;
    };
    const Vec2 from = centre(0), to = centre(1), apart = to - from;
    trial.feed(fed + ", at rest");
    trial.at_most(-dot(still, apart) / std::sqrt(dot(apart, apart)), 1e-12 * size,
                  "pull on body 1 [N/m] towards body 0");
    for (const double speed : {0.1, 3.0, 1e3}) {
      trial.feed(fmt::format("{}, parting at {:g} m/s", fed, speed));
      law.bodies[1].motion.velocity = speed * still / size;
      const Evaluation parting = law.look();
      trial.at_most(-dot(parting.on(1), still) / size, 1e-12 * size,
                    "pull on body 1 [N/m] along the way it goes");
      for (const ContactReport& contact : parting.contacts) {
        trial.at_most(-(contact.px * still.x + contact.py * still.y) / size, 1e-9 * size,
                      "reported normal force that pulls [N/m]");
      }
    }
  };
  for (const double overhang : {-0.2, 0.0, 0.2}) {
    expect_no_pull({box(0, 0, 1, 1), box(-overhang, 0.99, 1 + overhang, 2)},
                   fmt::format("a box 10 mm deep in another, {:g} m wider to either side", overhang));
  }
  for (const HeldPair& pair : random_pairs(72)) {
    if (pair.name.find("corner on flat") != std::string::npos) expect_no_pull(pair.bodies, pair.name);
  }
}

/// Beside the interface that applies there are others, which no number may come from.
void check_interfaces(const Subject& subject, Trial& trial) {
  if (subject.component->component->interface_parameter_count == 0) {
    trial.not_claimed("no interface parameters");
    return;
  }
  Values other = lively_interface();
  for (auto& [key, value] : other) value *= 0.5;
  for (const HeldPair& pair : pairs_without_ties(24)) {
    for (const bool plain : {true, false}) {
      trial.feed(fed_pair(pair, 0.5) + (plain ? "" : ", not plain") +
                 ", the second of three interfaces, beside the same alone");
      const auto forces = [&](const std::vector<Values>& interfaces, std::uint32_t row) {
        DrivenLaw law(*subject.component);
        law.set_interfaces(interfaces, [row](std::uint32_t, std::uint32_t) { return row; });
        law.bodies = pair.bodies;
        law.plain = plain;
        law.step();
        return law.step();
      };
      const Evaluation alone = forces({lively_interface()}, 0),
                       among = forces({other, lively_interface(), other}, 1);
      for (std::size_t body = 0; body < 2; ++body) {
        trial.at_most(difference(alone.forces[body], among.forces[body]), 0,
                      fmt::format("difference of force [N/m] or moment [N] on body {}", body));
      }
    }
  }
}

void check_joint(const Subject& subject, Trial& trial) {
  struct Base {
    const char* name;
    HeldBody body;
    double speed;  ///< m/s; of 0.1 friction still sticks where a joint is passed
  };
  const Base divided[] = {
      {"a base with joints at 0.51, 0.55 and -0.48 m",
       held({{-2, -1}, {2, -1}, {2, 0}, {0.55, 0}, {0.51, 0}, {-0.48, 0}, {-2, 0}}), 10},
      {"a base with joints at 0.005 and 0.03 m",
       held({{-2, -1}, {2, -1}, {2, 0}, {0.03, 0}, {0.005, 0}, {-2, 0}}), 10},
      {"a base with joints at 0.5001, 0.0001 and -0.4999 m",
       held({{-2, -1}, {2, -1}, {2, 0}, {0.5001, 0}, {0.0001, 0}, {-0.4999, 0}, {-2, 0}}), 0.1}};
  for (const Base& base : divided) {
    for (const bool corner : {false, true}) {
      DrivenLaw whole(*subject.component), passing(*subject.component);
      const HeldBody above = corner ? corner_in_flat()[1] : flat_on_flat()[1];
      whole.bodies = {box(-2, -1, 2, 0), above};
      passing.bodies = {base.body, above};
      for (DrivenLaw* law : {&whole, &passing}) {
        law->master_share = 1;  // of the flat: a corner in it then has one force
        law->bodies[1].motion.velocity = {base.speed, 0};
      }
      for (int i = 0; i < 100; ++i) {
        const Vec2 smooth = whole.step().on(1), kicked = passing.step().on(1);
        trial.feed(fmt::format("{} {:.4g} m along {} at {:g} m/s, beside the same base without joints",
                               corner ? "a corner" : "a block", whole.bodies[1].motion.u.x, base.name,
                               base.speed));
        trial.at_most(std::hypot(smooth.x - kicked.x, smooth.y - kicked.y),
                      1e-9 * std::hypot(smooth.x, smooth.y), "difference of the two forces [N/m]");
      }
    }
  }
}

void check_strips(const Subject& subject, Trial& trial) {
  struct Meeting {
    const char* name;
    std::vector<HeldBody> bodies;
    bool flat;
  };
  const Meeting meetings[] = {{"a block 1 mm deep in a base", flat_on_flat(), true},
                              {"a corner of 60 degrees 2 mm deep in a side", corner_in_flat(), false}};
  const double rounded = 1e-15 * scale_of(subject, trial);
  for (const Meeting& meeting : meetings) {
    for (const int kind : {1, 2, 3}) {
      trial.feed(fmt::format("{}, {} in strips 5 mm deep, moving", meeting.name,
                             kind == 1   ? "the lower body"
                             : kind == 2 ? "the upper body"
                                         : "both"));
      DrivenLaw law(*subject.component, undamped_interface()),
          whole(*subject.component, undamped_interface());
      law.bodies = whole.bodies = meeting.bodies;
      if ((kind & 1) != 0) law.bodies[0] = in_strips(law.bodies[0], 77, 5e-3);
      if ((kind & 2) != 0) law.bodies[1] = in_strips(law.bodies[1], 20, 5e-3);
      // Sides of a twentieth of the contact: what a law of points misses at either end is two of them.
      if (meeting.flat) {
        const double due = whole.look().on(1).y;
        trial.at_most(std::abs(law.look().on(1).y - due), 0.15 * due,
                      fmt::format("difference of the normal force [N/m], where {:.9g} is due", due));
      }
      for (DrivenLaw* one : {&law, &whole}) {
        one->bodies[1].motion.velocity = {0.05, -0.01};
        one->bodies[1].motion.rate = {0.01, -0.02, 0.02, 0.01};
      }
      for (int step = 0; step < 4; ++step) {
        const Evaluation e = law.step(), as_whole = whole.step();
        // What is left over between whole bodies is for the check of balance to say.
        const double allowed = 1e-11 * e.size() + rounded;
        trial.at_most(size_of(e.net_force()), allowed + 2 * size_of(as_whole.net_force()),
                      "resultant of all loads [N/m]");
        trial.at_most(std::abs(e.net_moment()), allowed + 2 * std::abs(as_whole.net_moment()),
                      "moment of all loads [N]");
        for (const LoadedCorner& load : e.corners) {
          trial.due(load.carries, "a load on an inner corner of a strip",
                    "loads at the ends of real sides alone");
        }
      }
    }
  }
}

}  // namespace talus::conformance
