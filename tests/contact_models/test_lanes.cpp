#include "contact_models/law_bench.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdint>

using namespace talus;
using namespace talus::bench;

namespace {

/// The same numbers everywhere, in [0, 1).
class Uniform {
 public:
  double operator()() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state_ >> 11) / 9007199254740992.0;
  }

 private:
  std::uint64_t state_ = 20261121;
};

HeldBody irregular(Uniform& uniform, std::size_t corners, double size) {
  std::vector<Vec2> outline;
  const double turn = 7 * uniform();
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle = turn + 6.283185307179586 * (static_cast<double>(i) + 0.6 * (uniform() - 0.5)) /
                                    static_cast<double>(corners);
    outline.push_back({size * std::cos(angle), size * std::sin(angle)});
  }
  return held(outline);
}

/// Puts the corner of b that is last in some direction behind that of a which is first, less deep than
/// `deepest`.
void bring_together(Uniform& uniform, const HeldBody& a, HeldBody& b, double deepest) {
  const double angle = 7 * uniform(), c = std::cos(angle), s = std::sin(angle);
  const auto furthest = [&](const HeldBody& body, double sign) {
    Vec2 best = body.pieces[0][0].at;
    for (const PieceCorner& corner : body.pieces[0]) {
      if (sign * (c * (corner.at.x - best.x) + s * (corner.at.y - best.y)) > 0) best = corner.at;
    }
    return best;
  };
  const Vec2 first = furthest(a, 1), last = furthest(b, -1);
  const double depth = deepest * uniform(), aside = 0.3 * depth * (uniform() - 0.5);
  b.centre = {a.centre.x + first.x - last.x - c * depth - s * aside,
              a.centre.y + first.y - last.y - s * depth + c * aside};
}

void set_moving(Uniform& uniform, HeldBody& body) {
  const auto some = [&] { return uniform() - 0.5; };
  body.motion.velocity = {some(), some()};
  body.motion.rate = {some(), some(), some(), some()};
}

/// Largest difference of what two evaluations say of the bodies' forces, in terms of all loads, those that a
/// dashpot takes away included.
double difference(const Evaluation& p, const Evaluation& q) {
  double worst = 0;
  for (std::size_t i = 0; i < p.forces.size(); ++i) {
    const BodyForce &f = p.forces[i], &g = q.forces[i];
    for (const double one : {f.force.x - g.force.x, f.force.y - g.force.y, f.moment.xx - g.moment.xx,
                             f.moment.xy - g.moment.xy, f.moment.yx - g.moment.yx, f.moment.yy - g.moment.yy})
      worst = std::max(worst, std::abs(one));
  }
  return worst / (p.size() + p.pairs[0].stored / p.pairs[0].penetration);
}

}  // namespace

TEST_CASE("Plain bodies side by side feel what they feel one by one", "[laws][lanes]") {
  const std::string law = GENERATE("overlap_area", "frictionless");
  const double share = GENERATE(0.0, 0.5, 1.0);
  const std::size_t most = GENERATE(4, 8);
  const double deepest = GENERATE(1e-4, 0.02, 0.3, 1.0);
  Uniform uniform;
  std::size_t touching = 0;
  double worst = 0, worst_energy = 0;
  for (int round = 0; round < 200; ++round) {
    const Values interface = law == "overlap_area"
                                 ? lively_interface()
                                 : Values{{"normal_stiffness", 1e9}, {"normal_damping", 0.3}};
    LawBench lanes(law, interface);
    for (const bool larger : {false, true}) {
      const double size = larger ? 1 + uniform() : 1;
      const std::size_t corners = 3 + static_cast<std::size_t>(uniform() * static_cast<double>(most - 2));
      lanes.bodies.push_back(irregular(uniform, corners, size));
    }
    bring_together(uniform, lanes.bodies[0], lanes.bodies[1], deepest);
    for (HeldBody& body : lanes.bodies) set_moving(uniform, body);
    lanes.master_share = share;
    LawBench general(law, interface);
    general.bodies = lanes.bodies;
    general.master_share = share;
    general.plain = false;
    for (int step = 0; step < 3; ++step) {
      const Evaluation fast = lanes.step(1e-5), due = general.step(1e-5);
      REQUIRE(fast.pairs[0].contact_count == due.pairs[0].contact_count);
      if (due.pairs[0].contact_count == 0) continue;
      ++touching;
      worst = std::max(worst, difference(due, fast));
      worst_energy = std::max(worst_energy, std::abs(fast.pairs[0].stored / due.pairs[0].stored - 1));
    }
  }
  CAPTURE(law, share, most, deepest, touching, worst, worst_energy);
  CHECK(touching > 100);
  CHECK(worst < 1e-8);
  CHECK(worst_energy < 1e-8);
}

TEST_CASE("Pairs of all shapes, side by side, feel what they feel one by one", "[laws][lanes]") {
  const double share = GENERATE(0.0, 0.5, 1.0);
  const std::size_t fewest = GENERATE(3, 4),
                    most = GENERATE(3, 4, 6);  // corners; groups of one shape and mixed
  if (fewest > most) return;
  constexpr std::size_t couples = 45;
  Uniform uniform;
  LawBench lanes("overlap_area");
  for (std::size_t i = 0; i < couples; ++i) {
    for (int one = 0; one < 2; ++one) {
      const auto corners =
          fewest + static_cast<std::size_t>(uniform() * static_cast<double>(most - fewest + 1));
      lanes.bodies.push_back(irregular(uniform, corners, 1));
      set_moving(uniform, lanes.bodies.back());
    }
    HeldBody &a = lanes.bodies[2 * i], &b = lanes.bodies[2 * i + 1];
    a.centre.x += 10 * static_cast<double>(i);
    bring_together(uniform, a, b, 0.02);
    lanes.met.emplace_back(2 * i, 2 * i + 1);
  }
  lanes.master_share = share;
  LawBench general("overlap_area");
  general.bodies = lanes.bodies;
  general.met = lanes.met;
  general.master_share = share;
  general.plain = false;
  for (int step = 0; step < 3; ++step) {
    const Evaluation fast = lanes.step(1e-5), due = general.step(1e-5);
    CAPTURE(share, fewest, most, step);
    std::size_t touching = 0;
    for (std::size_t i = 0; i < couples; ++i) {
      REQUIRE(fast.pairs[i].contact_count == due.pairs[i].contact_count);
      touching += due.pairs[i].contact_count;
      if (due.pairs[i].contact_count != 0)
        CHECK(fast.pairs[i].stored == Approx(due.pairs[i].stored).epsilon(1e-8));
    }
    CHECK(touching > couples / 2);
    CHECK(difference(due, fast) < 1e-8);
  }
}

TEST_CASE("Springs without stiffness carry nothing, side by side as well", "[laws][lanes]") {
  const std::string law = GENERATE("overlap_area", "frictionless");
  Values interface {
    {"normal_stiffness", 0}, { "normal_damping", 0.3 }
  };
  if (law == "overlap_area") interface = with(lively_interface(), {{"normal_stiffness", 0}});
  LawBench bench(law, interface);
  bench.bodies = {box(0, 0, 1, 1), box(0.2, 0.99, 1.1, 2)};
  Uniform uniform;
  for (HeldBody& body : bench.bodies) set_moving(uniform, body);
  for (int step = 0; step < 2; ++step) {
    const Evaluation found = bench.step(1e-5);
    CHECK(found.size() == 0);
    REQUIRE(found.pairs[0].contact_count == 1);
    CHECK(found.pairs[0].slip_loss == 0);
    CHECK(found.pairs[0].damping_power == 0);
    // In the frame of the first body, whose centre is at (0.5, 0.5) m.
    CHECK(found.contacts[0].x == Approx(0.1).margin(3e-5));  // they move at up to 1 m/s
    CHECK(found.contacts[0].y == Approx(0.495).margin(3e-5));
  }
}
