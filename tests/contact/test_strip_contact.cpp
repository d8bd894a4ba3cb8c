#include "contact/contact_stage.hpp"
#include "model/whole_motion.hpp"
#include "parallel/alone.hpp"
#include "simulation/simulation.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

using namespace talus;

namespace {

/// A square a and a kite b that points at its right side with a corner.
WorkingScene corner_on_flat(const std::string& cover_a, const std::string& cover_b, const std::string& law) {
  WorkingScene text;
  text.law = law;
  text.interface = R"("normal_stiffness": 1e9, "tangential_stiffness": 1e9, "friction_angle": 30,
                      "normal_damping": 0, "tangential_damping": 0)";
  text.bodies =
      box("a", 0, 0, 1, 1, cover_a) +
      R"(, {"name": "b", "material": "rock", "polygon": [[1, 0.5], [1.8, -0.1], [2.6, 0.7], [1.7, 1.5]], )" +
      cover_b + "}";
  return text;
}

const char* const block = R"("cover": {"model": "block"})";
const char* const coarse = R"("cover": {"model": "hexagonal", "size": 0.3, "angle": 7})";
const char* const fine = R"("cover": {"model": "hexagonal", "size": 0.11, "angle": 40})";

struct Loaded {
  double stored;
  Vec2 force_a, force_b;  ///< N/m
  double moment;          ///< N, of all loads about the origin
};

/// Loads when b is displaced as a whole.
class Pressed {
 public:
  explicit Pressed(const WorkingScene& text) : scene_(text.read()), model_(build_model(scene_)) {}

  Loaded at(double x, double y, double turn = 0) const {
    MotionState motion = displaced(x, y, turn);
    Loaded loaded{stored(motion), {}, {}, 0};
    add(motion, 0, loaded.force_a, loaded.moment);
    add(motion, 1, loaded.force_b, loaded.moment);
    return loaded;
  }

  /// How far the forces of b's patches are from minus the gradient of the energy, as a share of the largest.
  double off_gradient(double x, double y, double step) const {
    MotionState motion = displaced(x, y, 0);
    stored(motion);
    const std::vector<Vec2> forces(motion.patch_force.begin(), motion.patch_force.end());
    const CoverRanges& ranges = model_.ranges(model_.bodies[1]);
    double largest = 0, off = 0;
    for (std::uint32_t p = ranges.patch_begin; p < ranges.patch_end; ++p) {
      for (double Vec2::*component : {&Vec2::x, &Vec2::y}) {
        const auto moved = [&](double by) {
          MotionState there = displaced(x, y, 0);
          there.patch_displacement[p].*component += by;
          return stored(there);
        };
        const double due = -(moved(step) - moved(-step)) / (2 * step);
        off = std::max(off, std::abs(forces[p].*component - due));
        largest = std::max(largest, std::abs(due));
      }
    }
    return off / largest;
  }

 private:
  MotionState displaced(double x, double y, double turn) const {
    MotionState motion(model_);
    const CoverRanges& ranges = model_.ranges(model_.bodies[1]);
    const Matrix2 h{std::cos(turn) - 1, -std::sin(turn), std::sin(turn), std::cos(turn) - 1};
    motion.bodies[1].u = {x, y};
    motion.bodies[1].h = h;
    for (std::uint32_t p = ranges.patch_begin; p < ranges.patch_end; ++p) {
      const Vec2 star = model_.patch_star[p];
      motion.patch_displacement[p] = {x + h.xx * star.x + h.xy * star.y, y + h.yx * star.x + h.yy * star.y};
    }
    return motion;
  }

  /// J/m, with the loads.
  double stored(MotionState& motion) const {
    move_boundary(model_, motion);
    ContactStage contacts(scene_, model_, alone(), true);
    contacts.find_pairs(model_, motion, 0, {});
    return contacts.evaluate(model_, motion, {0, true, false}).stored;
  }

  /// Linear functions are carried exactly, so patch forces at their star points have the moment of the loads.
  void add(const MotionState& motion, std::uint32_t index, Vec2& force, double& moment) const {
    const Body& body = model_.bodies[index];
    const CoverRanges& ranges = model_.ranges(body);
    const auto act = [&](Vec2 load, Vec2 at) {
      force = {force.x + load.x, force.y + load.y};
      moment += (body.centre.x + at.x) * load.y - (body.centre.y + at.y) * load.x;
    };
    if (body.kinematics == Kinematics::covered) {
      for (std::uint32_t p = ranges.patch_begin; p < ranges.patch_end; ++p) {
        const Vec2 star = model_.patch_star[p], d = motion.patch_displacement[p];
        act(motion.patch_force[p], {star.x + d.x, star.y + d.y});
      }
      return;
    }
    const BodyForce& f = motion.forces[index];
    act(f.force, motion.bodies[index].u);
    moment += torque(motion.bodies[index], f);
  }

  Scene scene_;
  Model model_;
};

}  // namespace

TEST_CASE("between bodies of any covers the contact force is minus the gradient of its energy",
          "[contact][strips]") {
  const std::pair<const char*, const char*> covers[] = {
      {block, coarse}, {coarse, block}, {coarse, coarse}, {coarse, fine}, {fine, coarse}};
  const double whole = Pressed(corner_on_flat(block, block, "frictionless")).at(-0.01, 0.1).force_b.x;
  for (const auto& [a, b] : covers) {
    INFO(a << ' ' << b);
    const Pressed pressed(corner_on_flat(a, b, "frictionless"));
    for (const double depth : {1e-4, 0.01, 0.03}) {
      for (int i = 0; i < 12; ++i) {
        const double y = -0.2 + 0.037 * i, step = 1e-4 * depth;
        const Loaded here = pressed.at(-depth, y);
        const double fx =
            -(pressed.at(-depth + step, y).stored - pressed.at(-depth - step, y).stored) / (2 * step);
        const double fy =
            -(pressed.at(-depth, y + step).stored - pressed.at(-depth, y - step).stored) / (2 * step);
        CHECK(here.force_b.x == Approx(fx).epsilon(1e-6));
        CHECK(here.force_b.y == Approx(fy).margin(1e-6 * fx));
      }
    }
    // The force of a corner on a flat side does not depend on how either is covered.
    CHECK(pressed.at(-0.01, 0.1).force_b.x == Approx(whole).epsilon(1e-9));
  }
}

TEST_CASE(
    "where sides of a lattice have several stiffnesses its patches feel minus the gradient of the energy",
    "[contact][strips]") {
  const std::pair<const char*, const char*> covers[] = {{block, coarse}, {coarse, coarse}, {fine, coarse}};
  for (const auto& [a, b] : covers) {
    INFO(a << ' ' << b);
    WorkingScene text = corner_on_flat(a, b + std::string(R"(, "surfaces": {"soft": [0]})"), "frictionless");
    text.interface = R"("normal_stiffness": 1e9, "normal_damping": 0},
                       {"between": ["soft", "*"], "normal_stiffness": 1e8, "normal_damping": 0)";
    const Pressed pressed(text);
    for (const double depth : {1e-3, 0.01, 0.03}) {
      for (int i = 0; i < 4; ++i) CHECK(pressed.off_gradient(-depth, -0.2 + 0.11 * i, 1e-4 * depth) < 1e-5);
    }
  }
}

TEST_CASE("a specimen whose joint is softer than its outline rests under its loads", "[contact][strips]") {
  WorkingScene text;
  text.material =
      R"("density": 2600, "model": "linear_elastic", "young_modulus": 2e10, "poisson_ratio": 0.25)";
  text.interface = R"("normal_stiffness": 2e10, "tangential_stiffness": 2e10, "friction_angle": 30,
                      "normal_damping": 0.3, "tangential_damping": 0.3},
      {"between": ["joint", "joint"], "normal_stiffness": 2e9, "tangential_stiffness": 2e9, "friction_angle": 30,
       "normal_damping": 0.3, "tangential_damping": 0.3)";
  text.bodies =
      box("platen", -2, -1, 3, 0, R"("fixed": true)") + ", " +
      box("specimen", 0, 0, 1, 4,
          R"("cover": {"model": "hexagonal", "size": 0.25}, "surfaces": {"right": [1], "top": [2], "left": [3]},
                       "discontinuities": [{"points": [[-0.2, 0.8], [1.2, 3.2]], "surface": "joint"}])");
  text.rest = R"("surface_loads": [{"body": "specimen", "surface": "right", "pressure": 1e6},
                                   {"body": "specimen", "surface": "top", "pressure": 1e6},
                                   {"body": "specimen", "surface": "left", "pressure": 1e6}],
                 "settle": {"duration": 0.1, "damping": "adaptive"},)";
  text.time = R"({"end": 0.1})";
  const Simulation simulation = settle_and_run(text);
  CHECK(simulation.ledger().kinetic < 1e-4);
  CHECK(simulation.summary().largest_residual_share < 1e-6);
}

TEST_CASE("a divided body that nothing loads rests on the faces of its cut", "[contact][strips]") {
  for (const char* law : {"overlap_area", "vertex_edge", "feng_volume"}) {
    INFO(law);
    WorkingScene text;
    text.law = law;
    text.interface = R"("normal_stiffness": 6e8, "normal_damping": 0)";
    if (law != std::string("feng_volume"))
      text.interface += R"(, "tangential_stiffness": 1e8, "friction_angle": 20, "tangential_damping": 0)";
    text.bodies = box("a", 0, 0, 4, 2,
                      R"("cover": {"model": "hexagonal", "size": 0.4, "angle": 14.7, "offset_x": 0.03},
                         "discontinuities": [{"points": [[-1, 1], [5, 1.1]]}])");
    text.time = R"({"end": 2e-3})";
    const Simulation simulation = run_to_end(text);
    CHECK(simulation.ledger().kinetic < 1e-15);
    CHECK(simulation.summary().largest_residual_share < 1e-9);
  }
}

TEST_CASE("laws tell how deep a divided body is, not how far its parts reach askew", "[contact][strips]") {
  const std::string shapes[] = {
      box("a", 0, 0, 2, 1,
          R"("velocity": [0, -1], "cover": {"model": "hexagonal", "size": 0.4, "offset_x": 0.1})"),
      R"({"name": "a", "material": "rock", "cover": {"model": "rigid"}, "velocity": [0, -1],
          "polygon": [[0, 0], [2, 0], [2, 0.6], [0.7, 0.6], [0.7, 2], [0, 2]]})"};
  for (const char* law :
       {"overlap_area", "vertex_edge", "frictionless", "feng_volume", "potential_symmetric"}) {
    for (const std::string& shape : shapes) {
      INFO(law << ", " << shape);
      WorkingScene text;
      text.law = law;
      text.interface = R"("normal_stiffness": 1e5, "normal_damping": 0)";
      if (law == std::string("overlap_area") || law == std::string("vertex_edge"))
        text.interface += R"(, "tangential_stiffness": 1e5, "friction_angle": 20, "tangential_damping": 0)";
      text.bodies = box("base", -3, -1, 4, 0, R"("fixed": true)") + "," + shape;
      text.time = R"({"end": 1e-4, "dt": 1e-4})";  // one step
      CHECK(run_to_end(text).summary().largest_penetration == Approx(1e-4).epsilon(1e-4));
    }
  }
}

TEST_CASE("feng_volume finds one contact along a boundary of strips", "[contact][strips]") {
  const double whole = Pressed(corner_on_flat(block, block, "feng_volume")).at(-0.01, 0.1).force_b.x;
  const std::pair<const char*, const char*> covers[] = {{block, fine}, {coarse, fine}, {fine, coarse}};
  for (const auto& [a, b] : covers) {
    INFO(a << ' ' << b);
    const Pressed pressed(corner_on_flat(a, b, "feng_volume"));
    for (int i = 0; i < 12; ++i)
      CHECK(pressed.at(-0.01, -0.2 + 0.037 * i).force_b.x == Approx(whole).epsilon(1e-9));
  }
}

TEST_CASE("loads on bodies of any covers are equal and opposite and leave no moment", "[contact][strips]") {
  for (const char* law : {"frictionless", "overlap_area", "vertex_edge", "feng_volume", "cohesive_overlap",
                          "potential_symmetric"}) {
    for (const auto& [a, b] : {std::pair{block, fine}, std::pair{coarse, fine}}) {
      const Pressed pressed(corner_on_flat(a, b, law));
      for (const double turn : {0.0, 0.05, -0.15, -0.3}) {
        INFO(law << ' ' << a << ' ' << turn);
        const Loaded loaded = pressed.at(-0.02, 0.05, turn);
        const double size = std::hypot(loaded.force_b.x, loaded.force_b.y);
        CHECK(size > 0);
        CHECK(std::abs(loaded.force_a.x + loaded.force_b.x) <= 1e-11 * size);
        CHECK(std::abs(loaded.force_a.y + loaded.force_b.y) <= 1e-11 * size);
        CHECK(std::abs(loaded.moment) <= 1e-11 * size);
      }
    }
  }
}

TEST_CASE("an energy that passes over joints of either boundary has no jump", "[contact][strips]") {
  const Pressed pressed(corner_on_flat(coarse, fine, "frictionless"));
  const double due = pressed.at(-0.01, 0).stored;
  for (int i = 0; i <= 1000; ++i)
    CHECK(pressed.at(-0.01, -0.2 + 4e-4 * i + 1e-9).stored == Approx(due).epsilon(1e-9));
}

TEST_CASE("a tip whose bisector hardly turns loses none of its strips", "[contact][strips]") {
  const std::string lattice =
      R"("cover": {"model": "hexagonal", "size": 0.2, "offset_x": 0.013, "offset_y": 0.037, "angle": 7})";
  WorkingScene text = corner_on_flat(block, block, "frictionless");
  text.interface = R"("normal_stiffness": 1e10, "normal_damping": 0)";
  text.material =
      R"("density": 2000, "model": "linear_elastic", "young_modulus": 1e11, "poisson_ratio": 0.25)";
  text.bodies = R"({"name": "a", "material": "rock", "velocity": [0.5, 1e-5], "polygon":
                    [[-0.7091067811865475, -0.7071067811865475], [-0.002, 0],
                     [-0.7091067811865475, 0.7071067811865475], [-1.416213562373095, 1.1102230246251565e-16]], )" +
                lattice + "}, " + box("b", 0, -0.5, 1, 0.5, lattice);
  text.time = R"({"end": 0.025, "dt": 8e-6})";
  Simulation simulation(text.read(), {});
  while (simulation.advance()) {
  }
  CHECK(simulation.summary().largest_residual_share < 1e-4);
}

TEST_CASE("between searches strips are shaped where a pair lists them, and nowhere else",
          "[contact][strips]") {
  WorkingScene text;
  text.bodies = box("post", -0.5, -1, 0.5, 0, R"("fixed": true, "cover": {"model": "block"})") + ", " +
                box("beam", -10, 0, 10, 1, R"("cover": {"model": "hexagonal", "size": 0.3})") + ", " +
                R"({"name": "ell", "material": "rock", "cover": {"model": "block"},
                      "polygon": [[-1, 1.001], [1, 1.001], [1, 2], [0, 2], [0, 4], [-1, 4]]})";
  const Scene scene = text.read();
  const Model model = build_model(scene);
  MotionState motion(model);
  Workers two(2);
  ContactStage contacts(scene, model, two, true);
  contacts.find_pairs(model, motion, 0, {});
  const std::vector<BoundaryCorner> before = motion.corners;
  for (Vec2& d : motion.patch_displacement) d = {1e-4, -2e-4};
  for (Vec2& v : motion.patch_velocity) v = {0.1, -0.2};
  motion.bodies[2].h = {0, -1e-4, 1e-4, 0};
  MotionState all = motion;
  move_boundary(model, all);
  for (const std::uint32_t body : model.moving_bodies) motion.move_corners(model, body);
  REQUIRE_FALSE(contacts.find_pairs(model, motion, 1e-3, {0.3, 0.3, 0.3}));

  std::vector<char> listed(model.piece_body.size(), 0);
  const PiecePairs piece_pairs = contacts.piece_pairs();
  for (const BodyPair& pair : contacts.pairs()) {
    for (const PiecePair pieces : piece_pairs.of(pair)) listed[pieces.a] = listed[pieces.b] = 1;
  }
  std::size_t left = 0, shaped = 0;
  for (std::uint32_t piece = model.bodies[1].piece_begin; piece < model.piece_body.size(); ++piece) {
    const bool strip = model.is_strip[piece] != 0;
    for (std::uint32_t c = model.piece_start[piece] + (strip ? 2 : 0); c < model.piece_start[piece + 1];
         ++c) {
      const BoundaryCorner& due = listed[piece] != 0 ? all.corners[c] : before[c];
      if (strip) CHECK(motion.corners[c].x == due.x);
      if (strip) CHECK(motion.corners[c].vy == due.vy);
      CHECK(motion.corners[c].tangent_y == due.tangent_y);
      CHECK(motion.corners[c].length == due.length);
    }
    ++(listed[piece] != 0 ? shaped : left);
  }
  REQUIRE(model.bodies[2].piece_end == model.bodies[2].piece_begin + 2);
  CHECK(shaped > 5);
  CHECK(left > 5 * shaped);
}

TEST_CASE("the halves of a body that was cut anywhere meet as two bodies do", "[contact][strips]") {
  // Two lines through a unit square, one of them oblique, one from corner to corner.
  for (const char* line :
       {"[[-0.1, 0.3], [1.2, 0.4]]", "[[-0.1, -0.1], [1.1, 1.1]]", "[[0.2, 0.5], [0.7, 0.52]]"}) {
    for (const double size : {0.3, 0.1, 0.07}) {
      INFO(line << ' ' << size);
      WorkingScene text;
      text.gravity = "[0, -10]";
      text.bodies = box("table", -3, -1, 3, 0, R"("fixed": true)") + ", " +
                    box("a", 0, 0, 1, 1,
                        fmt::format(R"("cover": {{"model": "hexagonal", "size": {}}},
                                       "discontinuities": [{{"points": {}}}])",
                                    size, line));
      const Scene scene = text.read();
      const Model model = build_model(scene);
      MotionState motion(model);
      ContactStage contacts(scene, model, alone(), true);
      contacts.find_pairs(model, motion, 0, {});
      const ContactTotals untouched = contacts.evaluate(model, motion, {0, true, false});
      CHECK(untouched.penetration <= 1e-9);
      for (const Strip& strip : model.strips) {
        const BoundarySide& side = model.sides[strip.side];
        const double length = std::hypot(side.end.reference.x - side.start.reference.x,
                                         side.end.reference.y - side.start.reference.y);
        CHECK(strip.depth >= 0.02 * std::min(size, length));
      }
    }
  }
}
