#include "conformance/pairs.hpp"
#include "contact_models/law_bench.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace talus;
using namespace talus::bench;

namespace {

/// Laws whose normal force has a potential that depends on the place alone. Not so `vertex_edge`: its springs
/// count with the length a vertex carries, which changes with the place.
const std::vector<std::string> potential_laws{"overlap_area", "frictionless", "cohesive_overlap",
                                              "feng_volume", "potential_symmetric"};
/// Those among them whose pressure is the distance to the nearest side of the master.
const std::vector<std::string> distance_laws{"overlap_area", "frictionless", "cohesive_overlap"};

/// One generalised coordinate of a body: a component of u or of H.
struct Coordinate {
  const char* name;
  double Vec2::*shift;
  double Matrix2::*gradient;
};
const Coordinate coordinates[] = {{"x", &Vec2::x, nullptr},      {"y", &Vec2::y, nullptr},
                                  {"xx", nullptr, &Matrix2::xx}, {"xy", nullptr, &Matrix2::xy},
                                  {"yx", nullptr, &Matrix2::yx}, {"yy", nullptr, &Matrix2::yy}};

double& value_of(HeldBody& body, const Coordinate& q) {
  return q.shift != nullptr ? body.motion.u.*q.shift : body.motion.h.*q.gradient;
}

double force_of(const BodyForce& force, const Coordinate& q) {
  return q.shift != nullptr ? force.force.*q.shift : force.moment.*q.gradient;
}

/// Largest difference between forces and −∂Π/∂q over all coordinates of both bodies, as a share of Σ|F|.
double largest_miss(LawBench& bench, double depth) {
  const double size = bench.look().size(), h = 1e-5 * depth;
  double miss = 0;
  for (std::size_t body = 0; body < 2; ++body) {
    for (const Coordinate& q : coordinates) {
      const double force = force_of(bench.look().forces[body], q);
      double& value = value_of(bench.bodies[body], q);
      const double here = value;
      value = here + h;
      const double ahead = bench.look().pairs[0].stored;
      value = here - h;
      const double behind = bench.look().pairs[0].stored;
      value = here;
      miss = std::max(miss, std::abs(force + (ahead - behind) / (2 * h)) / size);
    }
  }
  return miss;
}

void at_rest(LawBench& bench, const HeldPair& pair) {
  bench.bodies = pair.bodies;
  for (HeldBody& body : bench.bodies) body.motion.velocity = {}, body.motion.rate = {};
}

}  // namespace

TEST_CASE("Force is minus the derivative of the stored energy in every coordinate of both bodies", "[laws]") {
  for (const std::string& law : potential_laws) {
    std::vector<HeldPair> pairs = random_pairs(72);
    for (const double degrees : {3.0, 40.0}) {
      for (const double chamfer : {0.01, 0.002}) pairs.push_back(chamfered(chamfer, degrees, 4e-3));
    }
    for (const double depth : {1e-3, 5e-3}) {
      pairs.push_back(saw_teeth(depth));
      pairs.push_back(body_in_notch(depth));
    }
    for (const HeldPair& pair : pairs) {
      for (const double share : {0.0, 0.5, 1.0}) {
        INFO(law << ", " << pair.name << ", master share " << share);
        LawBench bench(law);
        bench.master_share = share;
        at_rest(bench, pair);
        CHECK(largest_miss(bench, pair.depth) <= 1e-6);
      }
    }
  }
}

TEST_CASE("So it is where each side meets each side of the other body with another stiffness", "[laws]") {
  for (const std::string& law : distance_laws) {
    for (HeldPair& pair : random_pairs(72)) {
      // Of two corners head on the division lines meet, and the slope of the force changes there.
      if (pair.name.starts_with("corner on corner")) pair.bodies[1].motion.u.x += 0.03 * pair.depth;
      for (std::uint32_t b = 0; b < 2; ++b) {
        for (ConvexPiece& piece : pair.bodies[b].pieces) {
          std::uint32_t i = 0;
          for (PieceCorner& corner : piece) {
            if (corner.surface != internal_side) corner.surface = 2 * b + i++ % 2;
          }
        }
      }
      for (const double share : {0.0, 0.5, 1.0}) {
        INFO(law << ", " << pair.name << ", master share " << share);
        LawBench bench(law);
        bench.master_share = share;
        at_rest(bench, pair);
        std::vector<Values> rows;
        for (const double stiffness : {1e9, 3e8, 5e9, 2e9})
          rows.push_back(with(lively_interface(), {{"normal_stiffness", stiffness}}));
        bench.set_interfaces(rows, [](std::uint32_t i, std::uint32_t j) { return i % 2 + 2 * (j % 2); });
        CHECK(largest_miss(bench, pair.depth) <= 1e-6);
      }
    }
  }
}

TEST_CASE("Flat on flat: p = alpha g, and both roles agree", "[laws]") {
  for (const std::string& law : linear_laws()) {
    for (const double share : {0.0, 0.5, 1.0}) {
      INFO(law << ", master share " << share);
      LawBench bench(law);
      bench.master_share = share;
      bench.bodies = {box(0, 0, 1, 1), box(0, 0.999, 1, 2)};
      const Evaluation e = bench.look();
      // Each corner of the side owns half of the load; the corner cells of depth²/2 push outwards.
      CHECK(e.on(1).y == Approx(1e9 * 1e-3).epsilon(1.1e-3));
      CHECK(e.pairs[0].stored == Approx(1e9 * 1e-6 / 2).epsilon(1.1e-3));
      CHECK(e.pairs[0].penetration == Approx(1e-3).epsilon(1e-9));
    }
  }
}

TEST_CASE("A corner of 90 degrees at 30 degrees to a flat: the roles differ by 37 %, and they are declared",
          "[laws]") {
  // The flat as master: area d² (cot 30 + cot 60)/2. The corner as master: its cells are what its bisector
  // leaves, each pushing along its own side.
  constexpr double depth = 1e-3;
  const double pi = 3.14159265358979323846, flat = (std::sqrt(3.0) + 1 / std::sqrt(3.0)) / 2;
  const double cot75 = 1 / std::tan(75 * pi / 180);
  const double corner =
      (std::sqrt(3.0) - cot75) / 2 * std::cos(pi / 6) + (1 / std::sqrt(3.0) + cot75) / 2 * std::cos(pi / 3);
  CHECK(flat / corner == Approx(1.37).margin(0.005));
  for (const std::string& law : distance_laws) {
    for (const bool swapped : {false, true}) {
      for (const double share_of_flat : {1.0, 0.5, 0.0}) {
        INFO(law << ", swapped " << swapped << ", share of the flat " << share_of_flat);
        const HeldBody base = box(-1, -1, 1, 0);
        HeldBody tilted = moved(turned_by(30), box(-0.5, -0.5, 0.5, 0.5));
        double low = 0;
        for (const PieceCorner& c : tilted.pieces[0]) low = std::min(low, c.at.y);
        tilted.centre = {0.2, -low - depth};
        LawBench bench(law);
        bench.bodies = swapped ? std::vector{tilted, base} : std::vector{base, tilted};
        bench.master_share = swapped ? 1 - share_of_flat : share_of_flat;
        const double expected = share_of_flat * flat + (1 - share_of_flat) * corner;
        CHECK(bench.look().on(swapped ? 0 : 1).y == Approx(expected * 1e9 * depth * depth).epsilon(1e-9));
      }
    }
  }
}

TEST_CASE("Two interfaces under one overlap carry their own loads", "[laws]") {
  // Half of the block on a soft side, half on one ten times as stiff, whichever of the bodies is the master.
  for (const std::string& law : distance_laws) {
    for (const double share : {0.0, 0.5, 1.0}) {
      INFO(law << ", master share " << share);
      LawBench bench(law);
      bench.master_share = share;
      bench.bodies = {held({{-2, -1}, {2, -1}, {2, 0}, {0, 0}, {-2, 0}}, {0, 0, 1, 2, 0}),
                      held({{-0.5, -1e-3}, {0.5, -1e-3}, {0.5, 1}, {-0.5, 1}}, {3, 3, 3, 3})};
      bench.set_interfaces({with(lively_interface(), {{"normal_stiffness", 1e9}}),
                            with(lively_interface(), {{"normal_stiffness", 1e10}})},
                           [](std::uint32_t i, std::uint32_t j) { return i == 1 || j == 1 ? 1U : 0U; });
      const Evaluation e = bench.look();
      // Of a block that is master its flanks own a triangle of depth²/2 each.
      const double flanks = 1 - share, reach = 1e-3;
      CHECK(e.on(1).y == Approx(5.5e6 * (1 - flanks * reach)).epsilon(1e-9));
      CHECK(e.pairs[0].stored == Approx(5.5e9 * 1e-6 / 2 * (1 - flanks * reach * 2 / 3)).epsilon(1e-9));
      CHECK(std::abs(e.net_moment()) <= 1e-12 * e.size());
      // The stiff half lies at x > 0: the moment about the middle is (1e10 − 1e9) · 1e-3 · ½ · ¼, less what
      // the stiffer push on the immersed end, α d²/2 at 2/3 d, takes off.
      const BodyForce& force = e.forces[1];
      const Vec2 centre = bench.bodies[1].centre;
      const double moment = force.moment.yx - force.moment.xy + centre.x * force.force.y;
      CHECK(moment ==
            Approx(9e9 * 1e-3 / 8 - 9e9 * 1e-6 / 2 * (0.5 - 1e-3 / 3)).epsilon(share == 1 ? 1e-5 : 3e-3));
    }
  }
}
