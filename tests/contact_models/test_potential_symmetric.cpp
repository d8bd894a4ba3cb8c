#include "conformance/pairs.hpp"
#include "contact_models/law_bench.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace talus;
using namespace talus::bench;

namespace {

constexpr double per_metre = 1e9, sunk = 1e-3;

}  // namespace

TEST_CASE("potential_symmetric: equal squares push as with alpha g, less what is nearer to their other sides",
          "[laws][potential_symmetric]") {
  for (const double share : {0.0, 0.5, 1.0}) {
    LawBench bench("potential_symmetric", undamped_interface());
    bench.master_share = share;
    bench.bodies = {box(0, 0, 1, 1), box(0, 1 - sunk, 1, 2 - sunk)};
    const Evaluation e = bench.look();
    CHECK(e.on(1).y == Approx(per_metre * (sunk - sunk * sunk)).epsilon(1e-9));
    // ∫ of the depth behind the nearest side over d x 1, both corners being nearer to the other sides.
    CHECK(e.pairs[0].stored == Approx(per_metre * (sunk * sunk / 2 - std::pow(sunk, 3) / 3)).epsilon(1e-9));
    CHECK(e.pairs[0].penetration == Approx(sunk).epsilon(1e-9));
  }
}

TEST_CASE("potential_symmetric: other shapes are stiffer by mean height over height, each body by half",
          "[laws][potential_symmetric]") {
  // 4 x 1 m: heights 0.5 and 2 m, their harmonic mean by length 10/(8/0.5 + 2/2) m.
  LawBench bench("potential_symmetric", undamped_interface());
  bench.bodies = {box(-2, -1, 2, 0), box(-0.5, -sunk, 0.5, 1 - sunk)};
  const double due = per_metre * (10.0 / 17 / 0.5 + 1) / 2;
  CHECK(bench.look().on(1).y == Approx(due * sunk).epsilon(2e-3));
}

TEST_CASE("potential_symmetric: the declared stiffness bounds flat contacts of any shapes",
          "[laws][potential_symmetric]") {
  struct Meeting {
    std::vector<HeldBody> bodies;
    double length;  ///< m, of the contact
  };
  const Meeting meetings[] = {
      {{box(-2, -1, 2, 0), box(-0.5, 0, 0.5, 1)}, 1},
      {{box(-2, -0.05, 2, 0), box(-0.5, 0, 0.5, 0.02)}, 1},
      {{held({{-1, 0}, {0, -0.1}, {1, 0}}), held({{0, 3}, {-0.5, 0}, {0.5, 0}})}, 1},
      {{held({{-1, 0}, {-2, -0.2}, {2, -0.2}, {1, 0}}), held({{0.5, 0}, {2, 0.2}, {-2, 0.2}, {-0.5, 0}})},
       1}};
  for (const Meeting& meeting : meetings) {
    LawBench bench("potential_symmetric", undamped_interface());
    bench.bodies = meeting.bodies;
    constexpr double d = 1e-6;
    bench.bodies[1].motion.u.y = -d;
    const std::vector<double> values = bench.prepared(undamped_interface());
    const double measured = bench.look().on(1).y / d;
    CHECK(measured <= bench.law().stiffness(values.data(), meeting.length).normal);
    CHECK(measured >= 0.1 * per_metre);
  }
}

TEST_CASE("potential_symmetric: the dashpot is the stated share of critical of k b",
          "[laws][potential_symmetric]") {
  LawBench bench("potential_symmetric", lively_interface());
  bench.bodies = {box(-2, -1, 2, 0), box(-0.5, -sunk, 0.5, 1 - sunk)};
  const double still = bench.look().on(1).y;
  bench.bodies[1].motion.velocity = {0, -0.01};
  const Evaluation e = bench.look(1e-6);
  CHECK(e.on(1).y - still == Approx(2 * 0.2 * std::sqrt(per_metre * 1000) * 0.01).epsilon(1e-9));
  CHECK(e.pairs[0].damping_power == Approx((e.on(1).y - still) * 0.01 * 1e-6).epsilon(1e-9));
}
