#include "model/model.hpp"
#include "model/motion.hpp"
#include "simulation/working_scene.hpp"
#include "whole_motion.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <cmath>

using namespace talus;

namespace {

WorkingScene covered(const std::string& polygon, const std::string& cover, const std::string& more = "") {
  WorkingScene text;
  text.bodies = fmt::format(
      R"({{"name": "a", "material": "rock", "polygon": {}, "cover": {{"model": "hexagonal", {}}}{}}})",
      polygon, cover, more);
  return text;
}

const char* const ell = "[[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]]";

double signed_area(const MotionState& motion, std::uint32_t begin, std::uint32_t end) {
  double sum = 0;
  for (std::uint32_t c = begin; c < end; ++c) {
    const std::uint32_t next = c + 1 == end ? begin : c + 1;
    sum += motion.corners[c].x * motion.corners[next].y - motion.corners[next].x * motion.corners[c].y;
  }
  return sum / 2;
}

}  // namespace

TEST_CASE("row sums of a lattice are the mass of the body and keep its centre", "[model][cover]") {
  for (const char* slivers : {"merge", "mass_scale", "keep"}) {
    for (const char* place : {R"("size": 0.37)", R"("size": 0.5, "offset_x": 0.1, "angle": 17)"}) {
      const Model model =
          build_model(covered(ell, fmt::format(R"({}, "slivers": "{}")", place, slivers)).read());
      const Body& body = model.bodies[0];
      const CoverRanges& ranges = model.ranges(body);
      REQUIRE(body.kinematics == Kinematics::covered);
      double mass = 0;
      Vec2 moment;
      for (std::uint32_t p = ranges.patch_begin; p < ranges.patch_end; ++p) {
        CHECK(model.patch_mass[p] >= 0);
        mass += model.patch_mass[p];
        moment.x += model.patch_mass[p] * model.patch_star[p].x;
        moment.y += model.patch_mass[p] * model.patch_star[p].y;
      }
      CHECK(mass == Approx(2300 * 5).epsilon(1e-12));
      CHECK(std::abs(moment.x) <= 1e-11 * mass);
      CHECK(std::abs(moment.y) <= 1e-11 * mass);
    }
  }
}

TEST_CASE("every point of a body is carried by weights that sum to one and give back its place",
          "[model][cover]") {
  const Model model = build_model(covered(ell, R"("size": 0.4, "angle": 5)").read());
  for (const BoundarySide& side : model.sides) {
    Vec2 place;
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double weight = side.start.carrier.weight[i];
      const Vec2 star = model.patch_star[side.start.carrier.patch[i]];
      sum += weight;
      place = {place.x + weight * star.x, place.y + weight * star.y};
      CHECK(weight >= -1e-9);
    }
    CHECK(sum == Approx(1).epsilon(1e-13));
    CHECK(place.x == Approx(side.start.reference.x).margin(1e-12));
    CHECK(place.y == Approx(side.start.reference.y).margin(1e-12));
  }
  const MaterialPoint outside = model.point(0, {50, 50});
  CHECK(outside.carrier.weight[0] + outside.carrier.weight[1] + outside.carrier.weight[2] == Approx(1));
}

TEST_CASE("strips stand behind their sides, convex and apart", "[model][strips]") {
  for (const char* cover : {R"("size": 0.4)", R"("size": 0.31, "offset_x": 0.05, "angle": 11)"}) {
    const Model model = build_model(covered(ell, cover).read());
    const MotionState motion(model);
    const Body& body = model.bodies[0];
    double strips = 0;
    for (std::uint32_t piece = body.piece_begin; piece < body.piece_end; ++piece) {
      const std::uint32_t begin = model.piece_start[piece], end = model.piece_start[piece + 1];
      const Strip& strip = model.strips[model.piece_strip[piece]];
      const BoundarySide& side = model.sides[strip.side];
      CHECK(motion.corners[begin].x == side.start.reference.x);
      CHECK(motion.corners[begin + 1].y == side.end.reference.y);
      const double area = signed_area(motion, begin, end);
      CHECK(area > 0);
      strips += area;
      for (std::uint32_t c = begin; c < end; ++c) {
        // Every corner lies inside of every side, and no deeper than the strip.
        for (std::uint32_t k = begin; k < end; ++k) {
          const double depth = motion.corners[k].tangent_x * (motion.corners[c].y - motion.corners[k].y) -
                               motion.corners[k].tangent_y * (motion.corners[c].x - motion.corners[k].x);
          CHECK(depth >= -1e-9);
          if (k == begin) CHECK(depth <= strip.depth * (1 + 1e-9));
        }
      }
    }
    CHECK(strips < body.moments.area);
  }
}

TEST_CASE("where bisectors cross behind a short side the strips share the ground without overlap",
          "[model][strips]") {
  // A chamfer of 1 cm on a block of 1 m: the layer of depth d along the boundary has a known area.
  const Model model = build_model(
      covered("[[0, 0], [1, 0], [1, 0.99], [0.99, 1], [0, 1]]", R"("size": 0.4, "slivers": "keep")").read());
  const MotionState motion(model);
  double strips = 0, depth = 1;
  for (const Strip& strip : model.strips) depth = std::min(depth, strip.depth);
  for (std::uint32_t piece = 0; piece < model.piece_body.size(); ++piece) {
    REQUIRE(model.strips[piece].depth == Approx(depth));
    strips += signed_area(motion, model.piece_start[piece], model.piece_start[piece + 1]);
  }
  // Two squares differ by the layer, up to what the chamfer cuts off at both depths.
  const double inner = (1 - 2 * depth) * (1 - 2 * depth), chamfer = 0.01 * 0.01 / 2;
  CHECK(strips == Approx(1 - chamfer - inner).epsilon(1e-9));
}

TEST_CASE("a body of many elements turns and stretches with its patches", "[model][cover]") {
  const Model model = build_model(covered(ell, R"("size": 0.4, "angle": 3)").read());
  MotionState motion(model);
  const double c = std::cos(0.7), s = std::sin(0.7);
  const Matrix2 h{1.01 * c - 1, -s, 1.01 * s, c - 1};
  for (std::size_t p = 0; p < model.patch_star.size(); ++p) {
    const Vec2 star = model.patch_star[p];
    motion.patch_displacement[p] = {2 + h.xx * star.x + h.xy * star.y, -1 + h.yx * star.x + h.yy * star.y};
  }
  move_boundary(model, motion);
  motion.average(model, 0);
  CHECK(motion.bodies[0].u.x == Approx(2));
  CHECK(motion.bodies[0].u.y == Approx(-1));
  CHECK(motion.bodies[0].h.xx == Approx(h.xx).margin(1e-13));
  CHECK(motion.bodies[0].h.yx == Approx(h.yx).margin(1e-13));
  for (std::uint32_t piece = 0; piece < model.piece_body.size(); ++piece) {
    const MaterialPoint& start = model.sides[model.strips[model.piece_strip[piece]].side].start;
    const Vec2 due{2 + h.xx * start.reference.x + h.xy * start.reference.y,
                   -1 + h.yx * start.reference.x + h.yy * start.reference.y};
    CHECK(motion.corners[model.piece_start[piece]].x - start.reference.x == Approx(due.x).margin(1e-12));
    CHECK(motion.corners[model.piece_start[piece]].y - start.reference.y == Approx(due.y).margin(1e-12));
  }
}

TEST_CASE("the mean gradient of a body of many elements follows from the patches around it",
          "[model][cover]") {
  const std::string with_hole = R"(, "holes": [[[0.3, 0.3], [0.3, 0.7], [0.7, 0.7], [0.7, 0.3]]])";
  for (const char* cover : {R"("size": 0.11, "angle": 3)", R"("size": 0.13, "slivers": "keep")"}) {
    const Model model = build_model(covered(ell, cover, with_hole).read());
    const CoverRanges& ranges = model.ranges(model.bodies[0]);
    MotionState motion(model);
    for (std::size_t p = 0; p < model.patch_star.size(); ++p) {
      const double k = static_cast<double>(p);
      motion.patch_displacement[p] = {3 + std::sin(7 * k), std::cos(5 * k * k)};
      motion.patch_velocity[p] = {std::sin(11 * k), -20 + std::cos(3 * k * k)};
    }
    motion.average(model, 0);
    Matrix2 h, rate;
    const auto add = [](Matrix2& sum, double share, const Matrix2& of) {
      sum = {sum.xx + share * of.xx, sum.xy + share * of.xy, sum.yx + share * of.yx, sum.yy + share * of.yy};
    };
    for (std::size_t e = 0; e < model.elements.size(); ++e) {
      const double share = model.element_area[e] / model.bodies[0].moments.area;
      add(h, share, gradient(model.elements[e], motion.patch_displacement));
      add(rate, share, gradient(model.elements[e], motion.patch_velocity));
    }
    const auto same = [](const Matrix2& p, const Matrix2& q) {
      CHECK(p.xx == Approx(q.xx).margin(1e-12));
      CHECK(p.xy == Approx(q.xy).margin(1e-12));
      CHECK(p.yx == Approx(q.yx).margin(1e-12));
      CHECK(p.yy == Approx(q.yy).margin(1e-12));
    };
    same(motion.bodies[0].h, h);
    same(motion.bodies[0].rate, rate);
    CHECK(3 * (ranges.outer_end - ranges.outer_begin) < 2 * (ranges.patch_end - ranges.patch_begin));
  }
}

TEST_CASE("a cover that a body cannot have is refused with the names of both", "[model][cover]") {
  WorkingScene text;
  text.bodies = box("cracked", 0, 0, 1, 1, R"("discontinuities": [{"points": [[-1, 0.5], [2, 0.5]]}])");
  text.cover = "block";
  CHECK_THROWS_WITH(build_model(text.read()), Catch::Contains("'cracked'") && Catch::Contains("'block'") &&
                                                  Catch::Contains("hexagonal"));
}
