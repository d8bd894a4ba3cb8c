#include "conformance/pairs.hpp"
#include "contact_models/law_bench.hpp"
#include "simulation/working_scene.hpp"

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

using namespace talus;
using namespace talus::bench;

namespace {

/// Coordinates are rounded anew by 1e-15 m when a scene is moved.
constexpr double relative_rounding = 1e-11, moved_coordinate = 2e-15 * 1e9;

/// Two steps, so that history and increments count.
Evaluation after_two_steps(const std::string& law, const std::vector<HeldBody>& bodies, double share) {
  LawBench bench(law);
  bench.bodies = bodies;
  bench.master_share = share;
  bench.step();
  return bench.step();
}

double difference(const BodyForce& p, const BodyForce& q) {
  return std::max({std::abs(p.force.x - q.force.x), std::abs(p.force.y - q.force.y),
                   std::abs(p.moment.xx - q.moment.xx), std::abs(p.moment.xy - q.moment.xy),
                   std::abs(p.moment.yx - q.moment.yx), std::abs(p.moment.yy - q.moment.yy)});
}

void check_same(const Evaluation& here, const Evaluation& there, const Isometry& isometry) {
  const double allowed = relative_rounding * here.size() + moved_coordinate;
  CHECK(difference(moved(isometry, here.forces[0]), there.forces[0]) <= allowed);
  CHECK(difference(moved(isometry, here.forces[1]), there.forces[1]) <= allowed);
  CHECK(std::abs(here.pairs[0].stored - there.pairs[0].stored) <= 1e-11 * here.pairs[0].stored + 1e-14);
  CHECK(std::abs(here.pairs[0].slip_loss - there.pairs[0].slip_loss) <= 1e-10 * here.pairs[0].stored + 1e-14);
}

void check_moved(const Isometry& isometry, const std::vector<HeldPair>& pairs) {
  for (const std::string& law : laws()) {
    for (const HeldPair& pair : pairs) {
      for (const double share : {0.5, 1.0}) {
        INFO(law << ", " << pair.name << ", master share " << share);
        const std::vector<HeldBody> there{moved(isometry, pair.bodies[0]), moved(isometry, pair.bodies[1])};
        check_same(after_two_steps(law, pair.bodies, share), after_two_steps(law, there, share), isometry);
      }
    }
  }
}

std::vector<HeldPair> pairs_without_ties() {
  std::vector<HeldPair> pairs = random_pairs(72);
  for (HeldPair pair : {saw_teeth(1e-3), body_in_notch(1e-3), chamfered(0.01, 3, 4e-3)}) {
    set_moving(pair, 77);
    pairs.push_back(pair);
  }
  return pairs;
}

}  // namespace

TEST_CASE("Turning both bodies turns the forces", "[laws]") {
  check_moved(turned_by(37), pairs_without_ties());
  check_moved(turned_by(90), pairs_without_ties());
}

TEST_CASE("A mirror image of the bodies gives the mirror image of the forces", "[laws]") {
  check_moved(mirrored(), pairs_without_ties());
}

TEST_CASE("Bodies far from the origin meet as they do near it", "[laws]") {
  // The shift is a power of two and keeps few enough bits free to round the centres by 1e-10 m at most, so
  // the pair itself is moved: what is compared is the same two bodies at both places.
  for (const std::string& law : laws()) {
    for (const HeldPair& pair : pairs_without_ties()) {
      INFO(law << ", " << pair.name);
      std::vector<HeldBody> there = pair.bodies, here = pair.bodies;
      for (HeldBody& body : there) {
        body.centre.x += 0x1p19;
        body.centre.y += 0x1p22;
      }
      for (std::size_t i = 0; i < 2; ++i) {
        here[i].centre = {there[i].centre.x - 0x1p19, there[i].centre.y - 0x1p22};
      }
      const Evaluation near = after_two_steps(law, here, 0.5), far = after_two_steps(law, there, 0.5);
      CHECK(near.history == far.history);
      CHECK(difference(near.forces[0], far.forces[0]) == 0);
      CHECK(difference(near.forces[1], far.forces[1]) == 0);
    }
  }
}

TEST_CASE("The order of two bodies does not matter", "[laws]") {
  for (const std::string& law : laws()) {
    for (const HeldPair& pair : pairs_without_ties()) {
      for (const double share : {0.0, 0.5, 1.0}) {
        INFO(law << ", " << pair.name << ", master share " << share);
        Evaluation there = after_two_steps(law, {pair.bodies[1], pair.bodies[0]}, 1 - share);
        std::swap(there.forces[0], there.forces[1]);
        check_same(after_two_steps(law, pair.bodies, share), there, Isometry{});
      }
    }
  }
}

TEST_CASE("A velocity that both bodies share changes no force", "[laws]") {
  for (const std::string& law : laws()) {
    for (const HeldPair& pair : pairs_without_ties()) {
      INFO(law << ", " << pair.name);
      std::vector<HeldBody> boosted = pair.bodies;
      for (HeldBody& body : boosted) {
        body.motion.velocity.x += 8;
        body.motion.velocity.y -= 4;
      }
      // A velocity of 8 m/s itself is rounded by 1e-15 m/s, and a dashpot is worth some 1e6 N s/m.
      const Evaluation here = after_two_steps(law, pair.bodies, 0.5);
      const Evaluation there = after_two_steps(law, boosted, 0.5);
      const double allowed = relative_rounding * here.size() + 4 * moved_coordinate;
      CHECK(difference(here.forces[0], there.forces[0]) <= allowed);
      CHECK(difference(here.forces[1], there.forces[1]) <= allowed);
    }
  }
}

TEST_CASE("A corner carried along with its neighbour gets no friction", "[laws]") {
  // Eq. 38 as printed gives T = 0.83/mu of the slip limit here, for the two arcs differ in length.
  for (const std::string& law : laws()) {
    INFO(law);
    LawBench bench(law, undamped_interface());
    bench.bodies = {box(-1, -1, 1, 0), moved(turned_by(45), box(-0.5, -0.5, 0.5, 0.5))};
    bench.bodies[1].centre = {0.1, std::sqrt(0.5) - 1e-3};
    for (HeldBody& body : bench.bodies) body.motion.velocity = {1, 0};
    bench.step(1e-3);
    const Evaluation e = bench.step(1e-3);
    REQUIRE(e.contacts.size() == 1);
    CHECK(std::hypot(e.contacts[0].tx, e.contacts[0].ty) <=
          1e-12 * std::hypot(e.contacts[0].px, e.contacts[0].py));
  }
}

TEST_CASE("A base of two surfaces slides as far, whichever body is listed first and whichever is stiffer",
          "[laws]") {
  const std::string block =
      R"({"name": "block", "material": "rock", "polygon": [[0, 0], [1.5, 0], [2, 0], [2, 0.5], [0, 0.5]],
          "surfaces": {"smooth": [0], "rough": [1]}, "fix": ["rotation"], "velocity": [2, 0]})";
  const std::string floor = box("floor", -3, -1, 9, 0, R"("fixed": true)");
  const double degree = 3.14159265358979323846 / 180;
  const std::tuple<const char*, bool, double> cases[] = {
      {"overlap_area", true, 1e8},  {"overlap_area", false, 1e8},    {"overlap_area", true, 3e8},
      {"overlap_area", false, 2e7}, {"cohesive_overlap", true, 1e8}, {"cohesive_overlap", false, 3e8}};
  for (const auto& [law, first, rough] : cases) {
    INFO(law << (first ? ", block first, " : ", floor first, ") << rough);
    const double smooth_part = 1.5 * 1e8 / (1.5 * 1e8 + 0.5 * rough);  // of the weight, sunk evenly
    const double due =
        4 / (2 * 10 *
             (smooth_part * std::tan(10 * degree) + (1 - smooth_part) * std::tan(40 * degree)));  // v²/2a
    WorkingScene text;
    text.law = law;
    text.gravity = "[0, -10]";
    text.bodies = first ? block + ", " + floor : floor + ", " + block;
    const auto row = [](int friction, double stiffness) {
      return fmt::format(R"("normal_stiffness": {}, "tangential_stiffness": 1e8, "friction_angle": {},
                              "normal_damping": 0.3, "tangential_damping": 0.3)",
                         stiffness, friction);
    };
    text.interface = fmt::format(R"({}}}, {{"between": ["block/smooth", "rock"], {}}},
                                      {{"between": ["block/rough", "rock"], {})",
                                 row(20, 1e8), row(10, 1e8), row(40, rough));
    text.time = R"({"end": 1.5})";
    const Simulation ended = run_to_end(text);
    CHECK(ended.body_motion(first ? 0 : 1).displacement.x == Approx(due).epsilon(0.01));
  }
}
