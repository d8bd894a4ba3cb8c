#include "conformance/pairs.hpp"
#include "contact_models/law_bench.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace talus;
using namespace talus::bench;

namespace {

constexpr double kappa = 1e9, base_length = 1, shallow = 1e-3;

LawBench level_block(const Values& interface = lively_interface(), double depth = shallow) {
  LawBench bench("feng_volume", interface);
  bench.bodies = {box(-2, -1, 2, 0), box(-base_length / 2, -depth, base_length / 2, 1 - depth)};
  return bench;
}

}  // namespace

TEST_CASE("feng_volume: a flat contact carries kappa sqrt(A) b and stores 2/3 kappa A^1.5",
          "[laws][feng_volume]") {
  for (const double share : {0.0, 0.5, 1.0}) {
    LawBench bench = level_block();
    bench.master_share = share;
    const Evaluation e = bench.look();
    const double area = base_length * shallow;
    CHECK(e.on(1).y == Approx(kappa * std::sqrt(area) * base_length).epsilon(1e-12));
    CHECK(std::abs(e.on(1).x) <= 1e-12 * e.on(1).y);
    CHECK(e.pairs[0].stored == Approx(2 * kappa * std::pow(area, 1.5) / 3).epsilon(1e-12));
    CHECK(e.pairs[0].penetration == Approx(shallow).epsilon(1e-9));
    REQUIRE(e.contacts.size() == 1);
    CHECK(e.contacts[0].py == Approx(e.on(1).y).epsilon(1e-12));
  }
}

TEST_CASE("feng_volume: a touch that is rounding bears nothing", "[laws][feng_volume]") {
  for (const double depth : {1e-15, 3e-14, 9e-12}) {
    const Evaluation e = level_block(lively_interface(), depth).look();
    CHECK(e.on(1).y == 0);
    CHECK(e.pairs[0].stored == 0);
  }
  constexpr double seen = 1.1e-11;
  CHECK(level_block(lively_interface(), seen).look().on(1).y ==
        Approx(kappa * std::sqrt(seen)).epsilon(1e-4));
}

TEST_CASE("feng_volume: the resultant goes along the normal of the chord, through its middle",
          "[laws][feng_volume]") {
  // A corner of 90 degrees, turned by 30, in a side: chord d (cot 30 + cot 60), area ½ d times that.
  constexpr double depth = 1e-3;
  LawBench bench("feng_volume");
  HeldBody tilted = moved(turned_by(30), box(-0.5, -0.5, 0.5, 0.5));
  double low = 0, corner_x = 0;
  for (const PieceCorner& c : tilted.pieces[0]) {
    if (c.at.y < low) low = c.at.y, corner_x = c.at.x;
  }
  tilted.centre = {-corner_x, -low - depth};
  bench.bodies = {box(-1, -1, 1, 0), tilted};
  const Evaluation e = bench.look();
  const double cot30 = std::sqrt(3.0), chord = depth * (cot30 + 1 / cot30), area = depth * chord / 2;
  CHECK(e.on(1).y == Approx(kappa * std::sqrt(area) * chord).epsilon(1e-9));
  CHECK(std::abs(e.on(1).x) <= 1e-9 * e.on(1).y);
  const double left = -depth / cot30, right = depth * cot30;  // ends of the chord, or mirrored
  REQUIRE(e.contacts.size() == 1);
  CHECK(std::abs(e.contacts[0].x) == Approx((left + right) / 2).epsilon(1e-6));
  const BodyForce& force = e.forces[1];
  const double moment = force.moment.yx - force.moment.xy + tilted.centre.x * force.force.y;
  CHECK(moment == Approx(e.contacts[0].x * e.on(1).y).epsilon(1e-6));
}

TEST_CASE("feng_volume: two notched contacts of one pair have pressures of their own",
          "[laws][feng_volume]") {
  // A portal on a base: one foot deeper than the other.
  LawBench bench("feng_volume");
  bench.bodies = {box(-3, -1, 3, 0),
                  held({{-2, -1e-3}, {-1, -1e-3}, {-1, 1}, {1, 1}, {1, -4e-3}, {2, -4e-3}, {2, 2}, {-2, 2}})};
  const Evaluation e = bench.look();
  REQUIRE(e.contacts.size() == 2);
  const double forces[] = {e.contacts[0].py, e.contacts[1].py};
  CHECK(std::min(forces[0], forces[1]) == Approx(kappa * std::sqrt(1e-3)).epsilon(1e-9));
  CHECK(std::max(forces[0], forces[1]) == Approx(kappa * std::sqrt(4e-3)).epsilon(1e-9));
}

TEST_CASE("feng_volume: the dashpot is the stated share of critical where it stands", "[laws][feng_volume]") {
  LawBench bench = level_block();
  const double still = bench.look().on(1).y;
  bench.bodies[1].motion.velocity = {0, -0.01};
  const Evaluation e = bench.look(1e-6);
  const double stiffness = kappa * base_length / 2 * std::sqrt(base_length / shallow);
  CHECK(e.on(1).y - still == Approx(2 * 0.2 * std::sqrt(stiffness * 1000) * 0.01).epsilon(1e-9));
  CHECK(e.pairs[0].damping_power == Approx((e.on(1).y - still) * 0.01 * 1e-6).epsilon(1e-9));
}

TEST_CASE("feng_volume: the declared stiffness bounds contacts deeper than the least penetration",
          "[laws][feng_volume]") {
  const Values interface = undamped_interface();
  for (const double share : {1e-4, 1e-3, 1e-2, 0.1}) {
    LawBench bench = level_block(interface, share * base_length);
    const double h = 1e-6 * share;
    bench.bodies[1].motion.u.y = -h;
    const double deeper = bench.look().on(1).y;
    bench.bodies[1].motion.u.y = h;
    const double measured = (deeper - bench.look().on(1).y) / (2 * h);
    const std::vector<double> values = bench.prepared(interface);
    CHECK(measured <= bench.law().stiffness(values.data(), base_length).normal * (1 + 1e-6));
  }
}
