#include "conformance/pairs.hpp"
#include "contact_models/law_bench.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace talus;
using namespace talus::bench;

namespace {

const double mu = std::tan(25 * 3.14159265358979323846 / 180);

/// Follows a path with the upper body and adds up what is put in and what is booked, J/m.
struct Path {
  LawBench& bench;
  double work = 0, booked = 0, stored = 0, least_loss = 0;
  Evaluation last;

  explicit Path(LawBench& given) : bench(given) { last = bench.step(), stored = last.pairs[0].stored; }

  /// To u in straight steps.
  void go(Vec2 to, int steps = 400, double dt = 1e-4) {
    HeldBody& body = bench.bodies[1];
    const Vec2 from = body.motion.u;
    for (int i = 0; i < steps; ++i) {
      const Vec2 d{(to.x - from.x) / steps, (to.y - from.y) / steps};
      body.motion.velocity = {d.x / dt, d.y / dt};
      const Vec2 before = last.on(1);
      last = bench.step(dt);
      work -= (before.x + last.on(1).x) / 2 * d.x + (before.y + last.on(1).y) / 2 * d.y;
      booked += last.pairs[0].slip_loss;
      least_loss = std::min(least_loss, last.pairs[0].slip_loss);
    }
  }

  double gain() const { return last.pairs[0].stored - stored; }
};

/// A corner of 60 degrees, 2 mm deep in a flat: its contact length is proportional to its depth.
std::vector<HeldBody> corner_in_flat() {
  return {box(-1, -1, 1, 0), held({{0, -2e-3}, {0.5, 0.5 * std::sqrt(3.0)}, {-0.5, 0.5 * std::sqrt(3.0)}})};
}

std::vector<HeldBody> flat_on_flat() {
  return {box(-2, -1, 2, 0), box(-0.5, -1e-3, 0.5, 1)};
}

}  // namespace

TEST_CASE("Work goes into springs and friction: what is stored and lost is what was put in", "[laws]") {
  for (const std::string& law : laws()) {
    for (const auto& bodies : {corner_in_flat(), flat_on_flat()}) {
      for (const double angle : {0.0, 5.0, 25.0}) {
        INFO(law << ", phi " << angle << ", " << (bodies[1].pieces[0].size() == 3 ? "corner" : "flat"));
        LawBench bench(law, with(undamped_interface(), {{"friction_angle", angle}}));
        bench.bodies = bodies;
        Path path(bench);
        for (const Vec2 to :
             {Vec2{2e-4, 0}, {2e-4, 5e-4}, {-8e-4, 5e-4}, {-8e-4, -5e-4}, {5e-4, -2e-4}, {0, 0}}) {
          path.go(to);
        }
        const double turned_over = std::abs(path.work) + path.stored;
        CHECK(std::abs(path.work - path.gain() - path.booked) <= 2e-5 * turned_over);
        CHECK(path.least_loss >= -1e-6 * turned_over);
        const bool slides = angle > 0 && has_friction(law) && bodies[1].pieces[0].size() == 4;
        if (slides) CHECK(path.booked > 1e-3 * turned_over);
        if (angle == 0 || !has_friction(law)) CHECK(std::abs(path.booked) <= 1e-6 * turned_over);
      }
    }
  }
}

TEST_CASE("Closed shear cycles in stick create no energy while the contact shrinks and grows", "[laws]") {
  for (const std::string& law : laws()) {
    INFO(law);
    LawBench bench(law, with(undamped_interface(), {{"friction_angle", 89}}));
    bench.bodies = corner_in_flat();
    Path path(bench);
    for (int cycle = 0; cycle < 3; ++cycle) {
      // Shear where the contact is long, unload, shear back where it is short; then the other way round.
      for (const Vec2 to : {Vec2{1e-4, 0}, {1e-4, 1e-3}, {0, 1e-3}, {0, 0}}) path.go(to);
      CHECK(path.work >= -1e-5 * path.stored);
      for (const Vec2 to : {Vec2{0, 1e-3}, {1e-4, 1e-3}, {1e-4, 0}, {0, 0}}) path.go(to);
      CHECK(path.work >= -1e-5 * path.stored);
    }
    CHECK(std::abs(path.work - path.gain() - path.booked) <= 1e-5 * path.stored);
  }
}

TEST_CASE("Return mapping: stick to the limit, slide at mu P, elastic again at once when turned back",
          "[laws]") {
  for (const std::string& law : frictional_laws()) {
    INFO(law);
    LawBench bench(law, undamped_interface());
    bench.bodies = flat_on_flat();
    Path path(bench);
    const double load = path.last.on(1).y;
    CHECK(load == Approx(1e6).epsilon(2e-3));
    path.go({1e-4, 0});
    CHECK(-path.last.on(1).x == Approx(7e8 * 1e-4).epsilon(2e-3));
    path.go({5e-3, 0});
    CHECK(-path.last.on(1).x == Approx(mu * load).epsilon(1e-3));  // the limit counts the corner cells too
    CHECK(path.last.contacts[0].slipping == 1);
    path.go({5e-3 - 1e-4, 0});
    CHECK(-path.last.on(1).x == Approx(mu * load - 7e8 * 1e-4).epsilon(2e-3));
    CHECK(path.last.contacts[0].slipping == 0);
  }
}

TEST_CASE("The paper's rule: V := 0 at slip, full friction until the slip turns, then from nothing",
          "[laws]") {
  LawBench bench("overlap_area", undamped_interface(), {{"friction_rule", 1}});
  bench.bodies = flat_on_flat();
  Path path(bench);
  const double load = path.last.on(1).y;
  path.go({1e-4, 0});
  CHECK(-path.last.on(1).x == Approx(7e8 * 1e-4).epsilon(1e-9));
  path.go({5e-3, 0});
  CHECK(-path.last.on(1).x == Approx(mu * load).epsilon(1e-3));
  CHECK(path.last.pairs[0].stored == Approx(path.stored).epsilon(1e-9));  // V is zero
  path.go({5e-3 - 1e-4, 0}, 1000);
  // Turned back, the spring starts from zero and pushes the other way: the friction drops by mu P in one
  // step.
  CHECK(path.last.on(1).x == Approx(7e8 * 1e-4).epsilon(1e-6));
}

TEST_CASE("Tangential dashpots act in stick only and take energy", "[laws]") {
  for (const std::string& law : frictional_laws()) {
    INFO(law);
    LawBench bench(law, with(lively_interface(), {{"normal_damping", 0}}));
    bench.bodies = flat_on_flat();
    bench.step();
    bench.bodies[1].motion.velocity = {0.01, 0};
    const Evaluation e = bench.step(1e-6);
    const double m = 2000 / 2.0;
    const double whole = 2 * 0.3 * std::sqrt(7e8 * m) * 0.01 + 7e8 * 0.01 * 1e-6;
    CHECK(-e.on(1).x == Approx(whole).epsilon(5e-3));
    CHECK(e.pairs[0].damping_power > 0);
    bench.bodies[1].motion.velocity = {10, 0};
    const Evaluation sliding = bench.step(1e-3);
    CHECK(-sliding.on(1).x == Approx(mu * sliding.on(1).y).epsilon(1e-2));
    CHECK(sliding.pairs[0].damping_power == 0);
  }
}

TEST_CASE("Normal dashpots: the stated share of critical on the whole contact", "[laws]") {
  for (const std::string& law : linear_laws()) {
    INFO(law);
    LawBench bench(law, with(lively_interface(), {{"tangential_damping", 0}}));
    bench.bodies = flat_on_flat();
    const double still = bench.look().on(1).y;
    bench.bodies[1].motion.velocity = {0, -0.01};
    const Evaluation e = bench.look(1e-6);
    const double whole = 2 * 0.2 * std::sqrt(1e9 * 1000) * 0.01;
    CHECK(e.on(1).y - still == Approx(whole).epsilon(5e-3));
    CHECK(e.pairs[0].damping_power == Approx((e.on(1).y - still) * 0.01 * 1e-6).epsilon(5e-3));
  }
}

TEST_CASE("The friction of a base is that of the base, not that of the sides beside it", "[laws]") {
  for (const std::string law : {"overlap_area", "cohesive_overlap"}) {
    INFO(law);
    LawBench bench(law, undamped_interface());
    bench.set_interfaces({with(undamped_interface(), {{"friction_angle", 25}}),
                          with(undamped_interface(), {{"friction_angle", 0}})},
                         [](std::uint32_t p, std::uint32_t q) { return p == 1 || q == 1 ? 1U : 0U; });
    const double depth = 0.02;
    bench.bodies = {box(-2, -1, 2, 0),
                    held({{-0.5, -depth}, {0.5, -depth}, {0.5, 1}, {-0.5, 1}}, {0, 1, 1, 1})};
    bench.master_share = 1;
    bench.step();
    bench.bodies[1].motion.velocity = {10, 0};
    const Evaluation sliding = bench.step(1e-2);
    REQUIRE(sliding.on(1).y == Approx(1e9 * depth));
    CHECK(-sliding.on(1).x == Approx(mu * sliding.on(1).y).epsilon(1e-12));
  }
}

namespace {

/// A square that stands on a corner, 2 mm deep in a flat, one of its sides leaning by `tilt`.
std::vector<HeldBody> tilted_in_flat(double tilt) {
  const double angle = tilt * 3.14159265358979323846 / 180, c = std::cos(angle), s = std::sin(angle);
  return {box(-1, -1, 1, 0), held({{0, -2e-3}, {c, s - 2e-3}, {c - s, s + c - 2e-3}, {-s, c - 2e-3}})};
}

}  // namespace

TEST_CASE("A corner that slides is held by the friction of what presses it, and by no dashpot", "[laws]") {
  for (const std::string law : {"overlap_area", "cohesive_overlap", "frictionless"}) {
    for (const double tilt : {10.0, 30.0, 45.0}) {
      for (const double master_share : {0.0, 0.5, 1.0}) {
        for (const bool plain : {true, false}) {
          INFO(law << ", tilt " << tilt << ", share " << master_share << (plain ? ", plain" : ""));
          LawBench bench(law, with(lively_interface(), {{"normal_damping", 0.3}}));
          bench.bodies = tilted_in_flat(tilt);
          bench.master_share = master_share;
          bench.plain = plain;
          const double pressed = bench.step().on(1).y;
          bench.bodies[1].motion.velocity = {1, 0};
          const Evaluation sliding = bench.step(1e-2);
          const double friction = law == "frictionless" ? 0 : mu;
          CHECK(sliding.on(1).y == Approx(pressed));
          CHECK(std::abs(sliding.on(1).x + friction * pressed) <= 1e-9 * pressed);
          CHECK(sliding.pairs[0].damping_power <= 1e-9 * pressed * 1e-2);
          REQUIRE(sliding.contacts.size() == 1);
          CHECK(sliding.contacts[0].py == Approx(pressed));
        }
      }
    }
  }
}

TEST_CASE("Normal dashpots of a corner: the stated share of critical on its chord", "[laws]") {
  for (const double tilt : {20.0, 45.0}) {
    for (const double master_share : {0.0, 0.5, 1.0}) {
      INFO("tilt " << tilt << ", share " << master_share);
      LawBench bench("frictionless", with(lively_interface(), {{"normal_damping", 0.2}}));
      bench.bodies = tilted_in_flat(tilt);
      bench.master_share = master_share;
      const Evaluation still = bench.look();
      bench.bodies[1].motion.velocity = {0.003, -0.01};
      const Evaluation e = bench.look(1e-6);
      const double angle = tilt * 3.14159265358979323846 / 180,
                   chord = 2e-3 * (1 / std::tan(angle) + std::tan(angle));
      const double whole = 2 * 0.2 * std::sqrt(1e9 * chord * bench.given().pairs[0].reduced_mass) * 0.01;
      CHECK(e.on(1).y - still.on(1).y == Approx(whole).epsilon(1e-5));
      CHECK(std::abs(e.on(1).x) <= 1e-6 * whole);
      CHECK(e.pairs[0].damping_power == Approx(whole * 0.01 * 1e-6).epsilon(1e-5));
    }
  }
}

TEST_CASE("Friction is at most what springs and dashpots press together, on a ridge that a slab rocks on",
          "[laws]") {
  const HeldBody ridge = held({{-1, -1}, {1, -1}, {0, 0}});
  for (const double master_share : {0.5, 1.0}) {
    for (const bool plain : {true, false}) {
      for (const double lean : {-0.3, 0.0, 0.2}) {
        for (const double spin : {-8.0, -1.0, 0.0, 2.0, 20.0}) {
          for (const double rise : {-1.0, 0.0, 0.1, 0.2, 0.3, 1.0}) {
            INFO("share " << master_share << (plain ? ", plain" : "") << ", lean " << lean << ", " << spin
                          << " 1/s, " << rise << " m/s");
            LawBench bench("overlap_area", with(lively_interface(), {{"normal_damping", 1}}));
            bench.bodies = {ridge, held({{-1, -lean - 5e-3}, {1, lean - 5e-3}, {1, 1}, {-1, 1}})};
            bench.master_share = master_share;
            bench.plain = plain;
            bench.step();
            bench.bodies[1].motion.velocity = {3, rise};
            bench.bodies[1].motion.rate = {0, -spin, spin, 0};
            bench.bodies[1].motion.spin = spin;
            for (const ContactReport& contact : bench.look(1e-3).contacts)
              CHECK(std::hypot(contact.tx, contact.ty) <=
                    mu * std::hypot(contact.px, contact.py) * (1 + 1e-9) + 1e-6);
          }
        }
      }
    }
  }
}
