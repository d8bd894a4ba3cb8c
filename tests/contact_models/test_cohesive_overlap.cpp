#include "conformance/pairs.hpp"
#include "contact_models/law_bench.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace talus;
using namespace talus::bench;

namespace {

constexpr double across_joint = 1e9, along_joint = 7e8, cohesive = 2e5, tensile = 1e5, until_open = 1e-3,
                 until_slid = 2e-3;
const double mu_of_joint = std::tan(25 * 3.14159265358979323846 / 180);

Values joint(const Values& changes = {}) {
  const Values strength{{"cohesion", cohesive},
                        {"tensile_strength", tensile},
                        {"softening_opening", until_open},
                        {"softening_slip", until_slid}};
  return with(with(undamped_interface(), strength), changes);
}

/// A block of 1 x 1 m bonded to a wide base. Bodies, and what they did, J/m.
struct Joint {
  LawBench bench;
  double work = 0, booked = 0;
  Evaluation last;

  explicit Joint(double depth = 0, const Values& values = joint()) : bench("cohesive_overlap", values) {
    bench.bodies = {box(-2, -1, 2, 0), box(-0.5, -depth, 0.5, 1 - depth)};
    bench.bonds_form = true;
    last = bench.step();
    bench.bonds_form = false;
  }

  /// By u and a turn about the block's centre, in straight steps; the force on the block at the end.
  Vec2 go(Vec2 by, double turn = 0, int steps = 200, double dt = 1e-4) {
    BodyMotion& m = bench.bodies[1].motion;
    for (int i = 0; i < steps; ++i) {
      m.velocity = {by.x / steps / dt, by.y / steps / dt};
      m.rate = {0, -turn / steps / dt, turn / steps / dt, 0};
      const BodyForce before = last.forces[1];
      last = bench.step(dt);
      const BodyForce& now = last.forces[1];
      work -= ((before.force.x + now.force.x) * by.x + (before.force.y + now.force.y) * by.y) / 2 / steps;
      work -= (before.moment.yx + now.moment.yx - before.moment.xy - now.moment.xy) * turn / 2 / steps;
      booked += last.pairs[0].slip_loss;
    }
    m.velocity = {}, m.rate = {};
    return last.on(1);
  }

  double stored() const { return last.pairs[0].stored; }
};

bool same_forces(const Evaluation& p, const Evaluation& q) {
  if (p.corners.size() != q.corners.size()) return false;
  for (std::size_t i = 0; i < p.corners.size(); ++i) {
    if (p.corners[i].force.x != q.corners[i].force.x || p.corners[i].force.y != q.corners[i].force.y)
      return false;
  }
  return p.pairs[0].stored == q.pairs[0].stored && p.pairs[0].slip_loss == q.pairs[0].slip_loss;
}

}  // namespace

TEST_CASE("cohesive_overlap: without cohesion it is overlap_area to the bit", "[laws][cohesive_overlap]") {
  for (const HeldPair& pair : random_pairs(36)) {
    INFO(pair.name);
    LawBench plain("overlap_area"), bonded("cohesive_overlap");
    plain.bodies = bonded.bodies = pair.bodies;
    bonded.bonds_form = true;
    for (int i = 0; i < 4; ++i) CHECK(same_forces(plain.step(), bonded.step()));
  }
}

TEST_CASE("cohesive_overlap: tension up to the strength, softening, nothing", "[laws][cohesive_overlap]") {
  Joint joint;
  CHECK(joint.go({0, 9.9e-5}).y == Approx(-across_joint * 9.9e-5).epsilon(1e-9));
  CHECK(joint.booked == 0);
  CHECK(joint.go({0, 1e-6}).y == Approx(-tensile).epsilon(1e-9));
  // From 1e-4 m on it softens over 1 mm: half is left in the middle.
  CHECK(joint.go({0, 5e-4}).y == Approx(-tensile / 2).epsilon(1e-9));
  // Unloaded and loaded again along the secant, to the same point.
  CHECK(joint.go({0, -3e-4}).y == Approx(-tensile / 4).epsilon(1e-9));
  CHECK(joint.go({0, 3e-4}).y == Approx(-tensile / 2).epsilon(1e-9));
  CHECK(joint.go({0, 5.1e-4}).y == 0);
  CHECK(joint.last.contacts.empty());
  CHECK(joint.stored() == 0);
  CHECK(joint.work == Approx(joint.booked).epsilon(1e-9));
  CHECK(joint.booked ==
        Approx(tensile * (1e-4 + until_open) / 2).epsilon(1e-4));  // the last step ends past it
}

TEST_CASE("cohesive_overlap: a broken bond never heals", "[laws][cohesive_overlap]") {
  Joint joint;
  joint.go({0, 2e-3});
  CHECK(joint.go({0, -1.9e-3}).y == 0);                                        // 0.1 mm above the base
  CHECK(joint.go({0, -2e-4}).y == Approx(across_joint * 1e-4).epsilon(1e-3));  // 0.1 mm deep
  CHECK(joint.go({0, 1.5e-4}).y == 0);                                         // no tension any more
  Joint sheared(1e-3);
  sheared.go({5e-3, 0});
  CHECK(-sheared.go({1e-3, 0}).x == Approx(mu_of_joint * sheared.last.on(1).y).epsilon(1e-3));
  CHECK(sheared.last.contacts.size() == 1);
}

TEST_CASE("cohesive_overlap: shear up to c L + mu P, no more, then mu P", "[laws][cohesive_overlap]") {
  constexpr double depth = 1e-3;
  // It softens over ten times the slip in which friction comes up, so both are there at the peak all but.
  Joint joint(depth, ::joint({{"softening_slip", 1e-2}}));
  const double before = joint.stored();
  double peak = 0;
  for (int i = 0; i < 120; ++i) {
    const Vec2 force = joint.go({1e-4, 0}, 0, 5);
    const double limit = mu_of_joint * force.y + cohesive;
    peak = std::max(peak, -force.x / limit);
    CHECK(-force.x <= limit * (1 + 1e-9));
  }
  CHECK(peak >= 0.95);
  CHECK(-joint.last.on(1).x == Approx(mu_of_joint * joint.last.on(1).y).epsilon(1e-3));
  CHECK(std::abs(joint.work - joint.booked - (joint.stored() - before)) <= 1e-4 * joint.work);
}

TEST_CASE("cohesive_overlap: without pressure the strength in shear is c", "[laws][cohesive_overlap]") {
  Joint joint;
  const double yield = cohesive / along_joint;
  CHECK(-joint.go({yield, 0}).x == Approx(cohesive).epsilon(1e-9));
  CHECK(joint.booked <= 1e-12 * joint.work);
  CHECK(-joint.go({until_slid / 4, 0}).x == Approx(0.75 * cohesive).epsilon(1e-9));
  CHECK(joint.go({until_slid, 0}).x == 0);
  CHECK(joint.booked == Approx(cohesive * (yield + until_slid) / 2).epsilon(1e-4));
  CHECK(joint.work == Approx(joint.booked).epsilon(1e-9));
}

TEST_CASE("cohesive_overlap: tension lowers the strength in shear by mu sigma", "[laws][cohesive_overlap]") {
  Joint joint(0, ::joint({{"softening_slip", 0}, {"softening_opening", 0}}));
  joint.go({0, 5e-5});
  const double left = cohesive - mu_of_joint * across_joint * 5e-5;
  CHECK(-joint.go({0.999 * left / along_joint, 0}).x == Approx(0.999 * left).epsilon(1e-3));
  CHECK(joint.go({0.002 * left / along_joint, 0}).x == 0);
}

TEST_CASE("cohesive_overlap: paths that open, shear, turn and break lose what is booked",
          "[laws][cohesive_overlap]") {
  for (const double depth : {0.0, 2e-4}) {
    for (const double scale : {0.2, 1.0, 4.0}) {
      INFO("depth " << depth << ", scale " << scale);
      Joint joint(depth);
      const double before = joint.stored();
      double least = 0, turned_over = 0;
      const std::pair<Vec2, double> legs[] = {{{1e-4, 5e-5}, 0},  {{0, 1e-4}, 1e-4},    {{-3e-4, 0}, -2e-4},
                                              {{1e-4, -3e-4}, 0}, {{3e-4, 1e-4}, 3e-4}, {{0, 3e-4}, -5e-4},
                                              {{-2e-4, -2e-4}, 0}};
      for (const auto& [by, turn] : legs) {
        const double booked = joint.booked;
        joint.go({scale * by.x, scale * by.y}, scale * turn, 1000);
        least = std::min(least, joint.booked - booked);
        turned_over = std::max(turned_over, std::abs(joint.work) + joint.stored());
      }
      CHECK(std::abs(joint.work - joint.booked - (joint.stored() - before)) <= 1e-4 * turned_over);
      CHECK(least >= -1e-6 * turned_over);
      if (scale >= 1) CHECK(joint.booked > 1e-3 * turned_over);
    }
  }
}

TEST_CASE("cohesive_overlap: bonds of bodies that strain and turn are in balance and have a potential",
          "[laws][cohesive_overlap]") {
  Joint joint;
  BodyMotion& m = joint.bench.bodies[1].motion;
  m.u = {3e-5, 6e-5};
  m.h = {2e-5, -3e-5, 4e-5, 1e-5};
  joint.bench.bodies[0].motion.h = {0, 1e-5, -3e-5, 2e-5};
  const Evaluation e = joint.bench.look();
  REQUIRE(e.contacts.size() == 2);
  CHECK(std::abs(e.net_force().x) + std::abs(e.net_force().y) <= 1e-12 * e.size());
  CHECK(std::abs(e.net_moment()) <= 1e-12 * e.size());
  const auto derivative = [&](double& q) {
    constexpr double h = 1e-9;
    const double here = q;
    q = here + h;
    const double ahead = joint.bench.look().pairs[0].stored;
    q = here - h;
    const double behind = joint.bench.look().pairs[0].stored;
    q = here;
    return (ahead - behind) / (2 * h);
  };
  for (std::size_t body = 0; body < 2; ++body) {
    BodyMotion& motion = joint.bench.bodies[body].motion;
    const BodyForce& force = e.forces[body];
    const double allowed = 1e-6 * e.size();
    CHECK(std::abs(force.force.x + derivative(motion.u.x)) <= allowed);
    CHECK(std::abs(force.force.y + derivative(motion.u.y)) <= allowed);
    CHECK(std::abs(force.moment.xx + derivative(motion.h.xx)) <= allowed);
    CHECK(std::abs(force.moment.xy + derivative(motion.h.xy)) <= allowed);
    CHECK(std::abs(force.moment.yx + derivative(motion.h.yx)) <= allowed);
    CHECK(std::abs(force.moment.yy + derivative(motion.h.yy)) <= allowed);
  }
}

TEST_CASE("cohesive_overlap: a bonded side bends as stiffly as springs spread evenly",
          "[laws][cohesive_overlap]") {
  Joint joint(0, ::joint({{"tensile_strength", 1e9}, {"cohesion", 1e9}}));
  BodyMotion& m = joint.bench.bodies[1].motion;
  constexpr double turn = 1e-4;
  m.u = {-turn / 2, 6e-5};  // open all over; turned about the middle of the base
  m.h = {0, -turn, turn, 0};
  const BodyForce force = joint.bench.look().forces[1];
  // About the middle of the base, ½ m below the centre: α_N turn L³/12.
  const double about_centre = force.moment.yx - force.moment.xy;
  CHECK(-(about_centre + 0.5 * force.force.x) == Approx(across_joint * turn / 12).epsilon(1e-3));
}

TEST_CASE("cohesive_overlap: forms bonds only when told to, between sides that touch",
          "[laws][cohesive_overlap]") {
  LawBench bench("cohesive_overlap", joint());
  bench.bodies = {box(0, 0, 1, 1e-3),
                  box(0.2, 1e-3, 1.2, 2e-3)};  // thin plates: far sides face each other, too
  CHECK(bench.look().contacts.empty());
  bench.bonds_form = true;
  CHECK(bench.look().contacts.size() == 2);
  bench.bodies[1] = box(0.2, 1.001e-3, 1.2, 2e-3);
  CHECK(bench.look().contacts.empty());
  bench.bodies[1] = moved(turned_by(10), box(0.2, 1e-3, 1.2, 2e-3));
  CHECK(bench.look().contacts.size() <= 1);
}

TEST_CASE(
    "cohesive_overlap: a joint that closes from one end on is bonded along all of it, whichever end that is",
    "[laws][cohesive_overlap]") {
  for (const double tilt : {-0.1, 0.0, 0.1}) {  // degrees, about the middle of the face: 0.9 mm to either end
    INFO("tilted by " << tilt);
    LawBench bench("cohesive_overlap", joint());
    bench.bonds_form = bench.hold_stick = true;
    bench.bodies = {box(-2, -1, 2, 0), moved(turned_by(tilt), box(-0.5, 1e-6, 0.5, 1))};
    CHECK(bench.step().pairs[0].contact_count == (tilt == 0 ? 0 : 2));  // an overlap, and half a bond
    bench.bodies[1] = box(-0.5, -1e-6, 0.5, 1);
    CHECK(bench.step().pairs[0].contact_count == 3);
    bench.bodies[1] = box(-0.5, 1e-5, 0.5, 1);
    CHECK(bench.step().on(1).y == Approx(-across_joint * 1e-5).epsilon(1e-3));
  }
}

TEST_CASE("cohesive_overlap: while held, nothing breaks; once let go, what is too much does",
          "[laws][cohesive_overlap]") {
  Joint joint;
  joint.bench.hold_stick = joint.bench.bonds_form = true;
  CHECK(joint.go({0, 3e-3}).y == Approx(-across_joint * 3e-3).epsilon(1e-9));
  joint.bench.hold_stick = joint.bench.bonds_form = false;
  CHECK(joint.go({0, 0}, 0, 1).y == 0);
  CHECK(joint.booked == Approx(across_joint * 9e-6 / 2).epsilon(1e-9));
}

TEST_CASE("Bonds bear as much beside friction in each run of a bonded scene", "[laws][bonds]") {
  // A slab on 35 degrees that c A + N tan φ = 1.25 G sin 35° holds: from the geometry another has settled
  // into its bonds would begin with all of the slip, and friction with none.
  WorkingScene text;
  text.law = "cohesive_overlap";
  text.gravity = "[-5.62689, -8.03598]";
  text.material = R"("density": 2600)";
  text.interface = R"("normal_stiffness": 1e8, "tangential_stiffness": 1e8, "friction_angle": 20.4578,
      "normal_damping": 0.3, "tangential_damping": 0.3, "cohesion": 4.14e4, "softening_slip": 1e-3,
      "softening_opening": 1e-3)";
  text.bodies = box("base", -20, -5, 20, 0, R"("fixed": true)") + "," + box("slab", -5, 0, 5, 4);
  text.time = R"({"end": 1})";
  text.rest = R"("settle": {"duration": 1, "damping": "adaptive", "until": 1e-5},)";
  Simulation first(text.read(), {});
  REQUIRE(first.settle());
  Simulation second(text.read(), {});
  CHECK(second.take_geometry(first.geometry()) == "bonds may form, and do so where bodies are drawn");
  REQUIRE(second.settle());
  for (Simulation* simulation : {&first, &second}) {
    while (simulation->advance()) {
    }
    CHECK(std::abs(simulation->body_motion(1).displacement.x) < 1e-5);
  }
}
