#include "conformance/pairs.hpp"
#include "contact_models/law_bench.hpp"
#include "random/random.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace talus;
using namespace talus::bench;

namespace {

/// 1e-12 of the loads, and what a coordinate rounded by 1e-15 m is worth in force.
constexpr double relative = 1e-12, rounded_coordinate = 1e-15 * 1e9;

std::vector<HeldPair> all_pairs() {
  std::vector<HeldPair> pairs = random_pairs(72);
  for (HeldPair& pair : awkward_pairs()) pairs.push_back(std::move(pair));
  return pairs;
}

/// Unbalanced force and moment as a share of what is allowed.
double unbalance(const Evaluation& e) {
  const double allowed = relative * e.size() + rounded_coordinate;
  const Vec2 net = e.net_force();
  return std::max({std::abs(net.x), std::abs(net.y), std::abs(e.net_moment())}) / allowed;
}

bool finite(const Evaluation& e) {
  for (const double value : e.history) {
    if (!std::isfinite(value)) return false;
  }
  return std::isfinite(e.size()) && std::isfinite(e.pairs[0].stored + e.pairs[0].slip_loss);
}

}  // namespace

TEST_CASE("Loads are equal and opposite and leave no moment, whatever meets and moves", "[laws]") {
  for (const std::string& law : laws()) {
    for (const HeldPair& pair : all_pairs()) {
      for (const double share : {0.0, 0.5, 1.0}) {
        INFO(law << ", " << pair.name << ", master share " << share);
        LawBench bench(law);
        bench.bodies = pair.bodies;
        bench.master_share = share;
        for (int step = 0; step < 4; ++step) {
          const Evaluation e = bench.step();
          CHECK(unbalance(e) <= 1);
          CHECK(finite(e));
          CHECK(e.pairs[0].damping_power >= 0);
        }
      }
    }
  }
}

TEST_CASE("Pairs at random do overlap: the tests above mean something", "[laws]") {
  for (const std::string& law : laws()) {
    std::size_t loaded = 0;
    const auto pairs = all_pairs();
    for (const HeldPair& pair : pairs) {
      LawBench bench(law, undamped_interface());  // with a dashpot, those that part may be free of load
      bench.bodies = pair.bodies;
      if (bench.look().size() > 1) ++loaded;
    }
    INFO(law);
    CHECK(loaded >= pairs.size() - 6);
  }
}

TEST_CASE("Three bodies in one batch: each pair is balanced on its own", "[laws]") {
  for (const std::string& law : laws()) {
    INFO(law);
    LawBench bench(law);
    bench.bodies = {box(0, 0, 2, 0.5), box(0, 0.499, 1, 1), box(0.9995, 0.4985, 2, 1)};
    for (HeldBody& body : bench.bodies) body.motion.velocity = {body.centre.y, -0.1 * body.centre.x};
    bench.step();
    const Evaluation e = bench.step();
    CHECK(unbalance(e) <= 1);
    CHECK(e.pairs.size() == 3);
    for (const PairReport& report : e.pairs) CHECK(report.stored > 0);
  }
}

TEST_CASE("No force at a gap or where bodies touch without overlap", "[laws]") {
  for (const std::string& law : laws()) {
    for (const double gap : {0.0, 1e-9, 1e-3}) {
      INFO(law << ", gap " << gap);
      LawBench bench(law);
      bench.bodies = {box(0, 0, 1, 1), box(0.25, 1 + gap, 1.25, 2)};
      HeldPair pair{"", bench.bodies, 0};
      set_moving(pair, 3);
      bench.bodies = pair.bodies;
      const Evaluation e = bench.look();
      CHECK(e.size() == 0);
      CHECK(e.pairs[0].stored == 0);
      CHECK(e.pairs[0].penetration == 0);
    }
  }
}

TEST_CASE("A contact never pulls, however fast the bodies part", "[laws]") {
  for (const std::string& law : laws()) {
    for (const double overhang : {-0.2, 0.0, 0.2}) {
      for (const double speed : {0.1, 3.0, 1e3}) {
        INFO(law << ", overhang " << overhang << ", parting at " << speed << " m/s");
        LawBench bench(law);
        bench.bodies = {box(0, 0, 1, 1), box(-overhang, 0.99, 1 + overhang, 2)};
        const double still = bench.look().on(1).y;
        bench.bodies[1].motion.velocity = {0, speed};
        const Evaluation parting = bench.look();
        CHECK(parting.on(1).y >= -1e-12 * still);
        CHECK(parting.on(1).y <= still);
        for (const ContactReport& contact : parting.contacts) CHECK(contact.py >= 0);
      }
    }
  }
}

TEST_CASE("A corner never pulls, however fast it parts", "[laws]") {
  for (const std::string& law : laws()) {
    for (HeldPair pair : random_pairs(72)) {
      if (pair.name.find("corner on flat") == std::string::npos) continue;
      INFO(law << ", " << pair.name);
      LawBench bench(law);
      bench.bodies = pair.bodies;
      for (HeldBody& body : bench.bodies) body.motion.velocity = {}, body.motion.rate = {};
      const Vec2 still = bench.look().on(1);
      const double whole = still.x * still.x + still.y * still.y, size = std::sqrt(whole);
      REQUIRE(size > 0);
      for (const double speed : {0.1, 3.0}) {
        bench.bodies[1].motion.velocity = {speed * still.x / size, speed * still.y / size};
        const Vec2 parting = bench.look().on(1);
        const double along = parting.x * still.x + parting.y * still.y;
        CHECK(along >= -1e-12 * whole);
        CHECK(along <= (1 + 1e-12) * whole);
      }
    }
  }
}

TEST_CASE("Dashpots only ever take energy", "[laws]") {
  for (const std::string& law : laws()) {
    for (HeldPair pair : all_pairs()) {
      for (const double factor : {1.0, 10.0, 1e3}) {
        INFO(law << ", " << pair.name << ", speeds " << factor << " times as high");
        LawBench bench(law);
        bench.bodies = pair.bodies;
        for (HeldBody& body : bench.bodies) {
          BodyMotion& m = body.motion;
          m.velocity = {factor * m.velocity.x, factor * m.velocity.y};
          m.rate = {factor * m.rate.xx, factor * m.rate.xy, factor * m.rate.yx, factor * m.rate.yy};
        }
        CHECK(bench.look(1e-7).pairs[0].damping_power >= 0);
      }
    }
  }
}

TEST_CASE("What contacts report is the force on the second body and its moment", "[laws]") {
  for (const std::string& law : laws()) {
    std::size_t loaded = 0;
    double force = 0, moment = 0;
    for (const HeldPair& pair : random_pairs(72)) {
      LawBench bench(law, undamped_interface());
      bench.bodies = pair.bodies;
      bench.step();
      const Evaluation e = bench.step();
      const Vec2 a = bench.bodies[0].centre;
      double fx = 0, fy = 0, about = 0;
      for (const ContactReport& contact : e.contacts) {
        const double x = contact.px + contact.tx, y = contact.py + contact.ty;
        fx += x, fy += y, about += (contact.x + a.x) * y - (contact.y + a.y) * x;
      }
      for (const LoadedCorner& load : e.corners) {
        if (load.body != 1) continue;
        fx -= load.force.x, fy -= load.force.y, about -= load.at.x * load.force.y - load.at.y * load.force.x;
      }
      if (!(e.size() > 1)) continue;
      ++loaded;
      force = std::max(force, std::hypot(fx, fy) / e.size());
      moment = std::max(moment, std::abs(about) / e.size());
    }
    INFO(law);
    CHECK(loaded > 50);
    CHECK(force < 1e-9);
    // m, of bodies of a metre that are a millimetre deep: where pressures of several sides meet at a corner,
    // the distributed laws tell the place by their sizes, to less than the depth.
    CHECK(moment < (law == "potential_symmetric" ? 1e-9 : 1e-3));
  }
}

TEST_CASE("|T| <= mu P in every contact, sticking or slipping", "[laws]") {
  const double mu = std::tan(25 * 3.14159265358979323846 / 180);
  for (const std::string& law : laws()) {
    std::size_t slipping = 0, sticking = 0;
    for (const HeldPair& pair : random_pairs(144)) {
      // With the flat as master all cells push one way, and the resultant is the sum of their loads.
      if (pair.name.find("corner on flat") == std::string::npos) continue;
      INFO(law << ", " << pair.name);
      LawBench bench(law);
      bench.bodies = pair.bodies;
      bench.master_share = 1;
      for (int step = 0; step < 4; ++step) {
        for (const ContactReport& contact : bench.step(5e-4).contacts) {
          const double p = std::hypot(contact.px, contact.py), t = std::hypot(contact.tx, contact.ty);
          CHECK(t <= mu * p * (1 + 1e-9) + rounded_coordinate);
          (contact.slipping == 1 ? slipping : sticking) += 1;
        }
      }
    }
    if (!has_friction(law)) continue;
    CHECK(slipping > 3);
    CHECK(sticking > 50);
  }
}

TEST_CASE("A law without friction has no tangential force, and mu = 0 is a law without friction", "[laws]") {
  for (const std::string& law : laws()) {
    for (const HeldPair& pair : random_pairs(36)) {
      INFO(law << ", " << pair.name);
      LawBench bench(law, with(lively_interface(), {{"friction_angle", 0}}));
      bench.bodies = pair.bodies;
      bench.step();
      for (const ContactReport& contact : bench.step().contacts) {
        CHECK(contact.tx == 0);
        CHECK(contact.ty == 0);
      }
    }
  }
}

TEST_CASE("Slivers as thin as the rounding of their corners make no force and no moment",
          "[laws][slow_sanitised]") {
  // Such a sliver is not quite convex. With areas that cancel and moments that do not, its centroid was once
  // found 5e14 m away, and a force of 1e-6 N there overturned a wall.
  for (const std::string& law : laws()) {
    Random random(7);
    double force = 0, moment = 0, farthest = 0;
    std::size_t found = 0;
    for (int i = 0; i < 20000; ++i) {
      LawBench bench(law, undamped_interface());
      bench.bodies = {box(-0.5, -0.25, 0.5, 0.25), box(0.5, -0.25, 1.5, 0.25)};
      for (HeldBody& body : bench.bodies) {
        // Strains and shifts of a few roundings: the corners of the two all but coincide.
        const auto about = [&](double size) { return random.between(-size, size); };
        body.motion.h = {about(4e-16), about(4e-15), about(4e-15), about(2e-14)};
        body.motion.u = {about(4e-16), -4.67e-5 + about(2e-14)};
        body.motion.velocity = {0, random.between(-0.1, 0.1)};
      }
      for (int step = 0; step < 2; ++step) {
        const Evaluation e = bench.step(1e-5);
        force = std::max(force, e.size());
        for (const BodyForce& on_body : e.forces) {
          const Matrix2& m = on_body.moment;
          moment = std::max({moment, std::abs(m.xx), std::abs(m.xy), std::abs(m.yx), std::abs(m.yy)});
        }
        for (const ContactReport& contact : e.contacts) {
          farthest = std::max(farthest, std::hypot(contact.x, contact.y));
          ++found;
        }
      }
    }
    INFO(law << ": " << found << " contacts, " << force << " N/m, " << moment << " N, " << farthest
             << " m off");
    CHECK(found > 1000);
    CHECK(farthest < 0.6);
    // What pressure there is at such depths, 1e-13 m at most, over half a metre: α g, or κ √A.
    const double allowed = law == "feng_volume" ? 1e9 * std::sqrt(0.5 * 1e-13) * 0.5 : 1e-4;
    CHECK(force < allowed);
    CHECK(moment < allowed);
  }
}
