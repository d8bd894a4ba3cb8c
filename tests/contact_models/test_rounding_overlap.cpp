#include "contact_models/law_bench.hpp"
#include "random/random.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace talus;
using namespace talus::bench;

namespace {

constexpr double per_depth = 1e9, of_critical = 0.3, approach = 1, one_step = 1e-5;
constexpr double common_mass = 1000;  // kg/m, of two bodies of 2000

struct FaceToFace {
  std::vector<HeldBody> bodies;
  Vec2 across;     ///< unit normal of the side of body 0 that faces body 1
  double shorter;  ///< m, of the two sides that meet
};

/// Two rectangles of about a metre that meet along a side turned at random, less deep than 1e-16 to 1e-12 m
/// and out of parallel by as little, body 1 moving towards body 0.
FaceToFace meeting(Random& random) {
  const double angle = random.between(0, 2 * std::numbers::pi), tilt = std::pow(10, random.between(-18, -12));
  const auto half = [&] { return random.between(0.3, 1.3); };
  const double width[] = {half(), half()}, height[] = {half(), half()};
  const double depth = std::pow(10, random.between(-18, -12));
  const double aside = random.between(-0.5, 0.5) * (width[0] + width[1]),
               above = height[0] + height[1] - depth;
  FaceToFace met{{}, {-std::sin(angle), std::cos(angle)}, 2 * std::min(width[0], width[1])};
  for (int i = 0; i < 2; ++i) {
    const double turn = angle + (i == 0 ? 0 : random.between(-1, 1) * tilt);
    const double c = std::cos(turn), s = std::sin(turn);
    std::vector<Vec2> outline;
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
      outline.push_back({c * x * width[i] - s * y * height[i], s * x * width[i] + c * y * height[i]});
    met.bodies.push_back(held(outline));
  }
  Vec2& centre = met.bodies[1].centre;
  centre.x += std::cos(angle) * aside + met.across.x * above;
  centre.y += std::sin(angle) * aside + met.across.y * above;
  met.bodies[1].motion.velocity = {-approach * met.across.x, -approach * met.across.y};
  return met;
}

}  // namespace

// The dashpot is 2 ζ √(α m/L) per metre and role, each role acting by half on the arc that it sees. Of an
// overlap no deeper than rounding one role may see all of the side and the other next to nothing: were L the
// length of the latter, forces would be those of a point and without bound. The arc that one role sees tells
// up to twice its length, l: the force is then at most 2 ζ √(α m/l) (l + 2 l)/2 v, which is 3/√8 times that
// of L = 2 l. `potential_symmetric` divides by the chord of the closed overlap, which is one for both roles.
TEST_CASE("However an overlap of rounding looks to either role, the dashpot is that of a side at most",
          "[laws]") {
  const std::string law = GENERATE("overlap_area", "frictionless", "potential_symmetric");
  const Values interface =
      has_friction(law)
          ? with(lively_interface(), {{"normal_stiffness", per_depth}, {"normal_damping", of_critical}})
          : Values{{"normal_stiffness", per_depth}, {"normal_damping", of_critical}};
  Random random(17);
  LawBench bench(law, interface);
  int touching = 0;
  double largest = 0;  // force or power, in terms of the bound
  for (int round = 0; round < 20'000; ++round) {
    const FaceToFace met = meeting(random);
    bench.bodies = met.bodies;
    const Evaluation found = bench.look(one_step);
    if (found.pairs[0].contact_count == 0) continue;
    ++touching;
    const double due = 2 * of_critical * std::sqrt(per_depth * common_mass * met.shorter) * approach;
    const double force = found.on(1).x * met.across.x + found.on(1).y * met.across.y;
    const double power = found.pairs[0].damping_power / one_step / approach;
    largest = std::max({largest, force / due, power / due});
  }
  CAPTURE(law, touching, largest);
  CHECK(touching > 5000);
  CHECK(largest > 0.5);  // sides of equal length that meet all along
  CHECK(largest < 3 / std::sqrt(8) * (1 + 1e-6));
}

// A quadrilateral and a triangle that meet in a corner, give or take rounding: some of their overlaps, of
// 1e-30 m², are in the cell of no side. Memory for the history of t_n comes as other pairs have left it.
TEST_CASE("Of an overlap of rounding, too, the history is written", "[laws]") {
  Random random(18);
  LawBench bench("overlap_area");
  bench.plain = false;
  int touching = 0, unwritten = 0;
  for (int round = 0; round < 20'000; ++round) {
    const double angle = random.between(0, 2 * std::numbers::pi);
    const auto placed = [&](std::vector<Vec2> outline) {
      for (Vec2& at : outline) {
        const Vec2 given = at;
        at.x = std::cos(angle) * given.x - std::sin(angle) * given.y + random.between(-4e-15, 4e-15);
        at.y = std::sin(angle) * given.x + std::cos(angle) * given.y + random.between(-4e-15, 4e-15);
      }
      return held(outline);
    };
    bench.bodies = {placed({{10, -13}, {10, 8}, {-10, 13}, {-10, -8}}),
                    placed({{10, -34}, {30, -18}, {10, -13}})};
    const Evaluation found = bench.look(one_step);
    touching += found.pairs[0].contact_count > 0 ? 1 : 0;
    unwritten +=
        std::any_of(found.history.begin(), found.history.end(), [](double kept) { return std::isnan(kept); })
            ? 1
            : 0;
  }
  CAPTURE(touching);
  CHECK(touching > 1000);
  CHECK(unwritten == 0);
}
