#include "geometry/outlines.hpp"
#include "scene/sample.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace talus;

namespace {

Ring rectangle(double x, double y, double length, double height, double turned_by = 0) {
  const double c = std::cos(turned_by), s = std::sin(turned_by);
  Ring ring;
  for (const Vec2 corner :
       {Vec2{x, y}, Vec2{x + length, y}, Vec2{x + length, y + height}, Vec2{x, y + height}}) {
    ring.push_back({c * corner.x - s * corner.y, s * corner.x + c * corner.y});
  }
  return ring;
}

std::vector<BodyOverlap> overlaps(const std::vector<Loops>& bodies) {
  std::vector<const Loops*> pointers;
  for (const Loops& loops : bodies) pointers.push_back(&loops);
  return overlapping_bodies(pointers);
}

}  // namespace

TEST_CASE("polygons written clockwise are turned, and surfaces stay on their edges", "[scene]") {
  const std::string ccw = "[[1, 1], [2, 1], [2, 2], [1, 2]]";
  const Scene written =
      sample::read(sample::good_but(ccw, ccw + ", \"surfaces\": {\"base\": [0], \"right\": [1]}"));
  const Scene turned = sample::read(sample::good_but(
      ccw, "[[1, 1], [1, 2], [2, 2], [2, 1]], \"surfaces\": {\"base\": [3], \"right\": [2]}"));
  const Loop &a = written.bodies[1].outer, &b = turned.bodies[1].outer;
  CHECK(signed_area(b.vertices) == 1);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK((a.vertices[i].x == b.vertices[i].x && a.vertices[i].y == b.vertices[i].y));
    CHECK(written.surfaces[a.surface_class[i]].surface == turned.surfaces[b.surface_class[i]].surface);
  }
}

TEST_CASE("holes come out clockwise, whichever way they were written", "[scene]") {
  for (const char* hole : {"[[1.2, 1.2], [1.8, 1.2], [1.8, 1.8]]", "[[1.2, 1.2], [1.8, 1.8], [1.8, 1.2]]"}) {
    const std::string ccw = "[[1, 1], [2, 1], [2, 2], [1, 2]]";
    const Scene scene = sample::read(sample::good_but(ccw, ccw + ", \"holes\": [" + hole + "]"));
    REQUIRE(scene.bodies[1].holes.size() == 1);
    CHECK(signed_area(scene.bodies[1].holes[0].vertices) == Approx(-0.18));
    CHECK(scene.bodies[1].holes[0].surface_class.size() == 3);
  }
}

TEST_CASE("sound shapes have no fault: convex, concave, subdivided, thin, far away", "[scene]") {
  CHECK(shape_faults({rectangle(0, 0, 1, 1)}).empty());
  CHECK(shape_faults({rectangle(0, 0, 1, 1e-6)}).empty());
  CHECK(shape_faults({rectangle(5e5, 5e6, 1, 1)}).empty());
  CHECK(shape_faults({{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 1}, {0, 2}}}).empty());
  CHECK(shape_faults({rectangle(0, 0, 4, 4), rectangle(1, 1, 1, 1), rectangle(2.5, 1, 1, 1)}).empty());
}

TEST_CASE("holes within holes and holes that touch are faults", "[scene]") {
  CHECK(shape_faults({rectangle(0, 0, 9, 9), rectangle(1, 1, 5, 5), rectangle(2, 2, 1, 1)}).size() == 1);
  CHECK(shape_faults({rectangle(0, 0, 9, 9), rectangle(1, 1, 2, 2), rectangle(3, 1, 2, 2)}).size() == 1);
}

TEST_CASE("the overlap of two bodies is told with its area", "[scene]") {
  for (const double angle : {0.0, 0.3, 1.0, std::numbers::pi / 6}) {
    const auto found = overlaps({{rectangle(0, 0, 2, 1, angle)}, {rectangle(1.5, 0.25, 2, 0.5, angle)}});
    REQUIRE(found.size() == 1);
    CHECK(found[0].area == Approx(0.25));
  }
}

TEST_CASE("touching bodies do not overlap, turned by any angle, near and far", "[scene]") {
  for (const double far : {0.0, 5e5}) {
    for (int i = 0; i < 200; ++i) {
      const double angle = 0.031 * i;
      CAPTURE(far, angle);
      CHECK(overlaps({{rectangle(far, 10 * far, 1, 0.5, angle)},
                      {rectangle(far + 1, 10 * far - 0.2, 1, 0.5, angle)},
                      {rectangle(far + 0.3, 10 * far + 0.5, 0.7, 0.5, angle)}})
                .empty());
    }
  }
}

TEST_CASE("an overlap counts from a millionth of the width on", "[scene]") {
  CHECK(overlaps({{rectangle(0, 0, 1, 1)}, {rectangle(0, 1 - 1e-8, 1, 1)}}).empty());
  CHECK(overlaps({{rectangle(0, 0, 1, 1)}, {rectangle(0, 1 - 1e-5, 1, 1)}}).size() == 1);
}

TEST_CASE("a body within the hole of another does not overlap it, but one within the other does", "[scene]") {
  const Loops ring{rectangle(0, 0, 3, 3), rectangle(1, 1, 1, 1)};
  CHECK(overlaps({ring, {rectangle(1, 1, 1, 1)}}).empty());
  CHECK(overlaps({ring, {rectangle(1.25, 1.25, 1, 0.5)}}).front().area == Approx(0.125));
  CHECK(overlaps({{rectangle(0, 0, 3, 3)}, {rectangle(1, 1, 1, 1)}}).front().area == Approx(1));
}

TEST_CASE("many touching bodies are checked in a moment", "[scene]") {
  std::vector<Loops> bodies;
  for (int i = 0; i < 10000; ++i) bodies.push_back({rectangle(i % 100, i / 100, 1, 1)});
  CHECK(overlaps(bodies).empty());
}

TEST_CASE("many thin slabs that lean are checked in a moment, and the one that is too high is found",
          "[scene]") {
  std::vector<Loops> bodies;
  for (int i = 0; i < 20000; ++i)
    bodies.push_back({rectangle(0, 0.001 * (i == 17 ? 17.5 : i), 50, 0.001, 0.5)});
  const std::vector<BodyOverlap> found = overlaps(bodies);
  REQUIRE(found.size() == 1);
  CHECK((found[0].a == 17 && found[0].b == 18));
  CHECK(found[0].area == Approx(0.025));
}
