#include "geometry/polygon.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace talus;

namespace {

const Ring sample_ring{{1, 2}, {5, 2}, {5, 4}, {1, 4}};

Ring rotated(const Ring& ring, double angle) {
  Ring result;
  for (const Vec2 p : ring) {
    result.push_back(
        {std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y});
  }
  return result;
}

}  // namespace

TEST_CASE("moments of a rectangle about any point are those of the closed form", "[geometry][polygon]") {
  const AreaMoments about_middle = ring_moments(sample_ring, {3, 3});
  CHECK(about_middle.area == Approx(8));
  CHECK(about_middle.x == Approx(0).margin(1e-14));
  CHECK(about_middle.y == Approx(0).margin(1e-14));
  CHECK(about_middle.xx == Approx(2 * 64 / 12.0));
  CHECK(about_middle.yy == Approx(4 * 8 / 12.0));
  CHECK(about_middle.xy == Approx(0).margin(1e-13));

  const AreaMoments about_origin = ring_moments(sample_ring, {0, 0});
  CHECK(about_origin.x == Approx(8 * 3));
  CHECK(about_origin.y == Approx(8 * 3));
  CHECK(about_origin.xx == Approx(2 * 64 / 12.0 + 8 * 9));
  CHECK(about_origin.xy == Approx(8 * 9));
}

TEST_CASE("area, first and second moments of a right triangle are those of the formulas",
          "[geometry][polygon]") {
  const double b = 3, h = 2;
  const AreaMoments m = ring_moments(Ring{{0, 0}, {b, 0}, {0, h}}, {0, 0});
  CHECK(m.area == Approx(b * h / 2));
  CHECK(m.x == Approx(b * b * h / 6));
  CHECK(m.y == Approx(b * h * h / 6));
  CHECK(m.xx == Approx(b * b * b * h / 12));
  CHECK(m.yy == Approx(b * h * h * h / 12));
  CHECK(m.xy == Approx(b * b * h * h / 24));
}

TEST_CASE("a ring of many sides has the moments of the disc", "[geometry][polygon]") {
  const double radius = 2, pi = std::acos(-1.0);
  const int sides = 2000;
  Ring ring;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * pi * i / sides;
    ring.push_back({10 + radius * std::cos(angle), -5 + radius * std::sin(angle)});
  }
  const AreaMoments m = ring_moments(ring, {10, -5});
  CHECK(m.area == Approx(pi * 4).epsilon(1e-5));
  CHECK(m.xx == Approx(pi * 16 / 4).epsilon(1e-5));
  CHECK(m.yy == Approx(pi * 16 / 4).epsilon(1e-5));
  CHECK(m.xy == Approx(0).margin(1e-12));
}

TEST_CASE("a reversed ring counts negative, so that a hole is taken out by adding", "[geometry][polygon]") {
  Ring reversed = sample_ring;
  std::reverse(reversed.begin(), reversed.end());
  const AreaMoments sum = ring_moments(sample_ring, {0.3, -7}) + ring_moments(reversed, {0.3, -7});
  for (const double value : {sum.area, sum.x, sum.y, sum.xx, sum.xy, sum.yy}) {
    CHECK(value == Approx(0).margin(1e-11));
  }

  Ring hole{{2, 2.5}, {2, 3.5}, {4, 3.5}, {4, 2.5}};
  const AreaMoments frame = ring_moments(sample_ring, {3, 3}) + ring_moments(hole, {3, 3});
  CHECK(frame.area == Approx(8 - 2));
  CHECK(frame.xx == Approx((2 * 64 - 1 * 8) / 12.0));
  CHECK(frame.yy == Approx((4 * 8 - 2 * 1) / 12.0));
}

TEST_CASE("moments about the centroid do not depend on where they were taken", "[geometry][polygon]") {
  const Ring ring = rotated({{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}}, 0.4);
  const CentralMoments here = about_centroid(ring_moments(ring, {0, 0}));
  const CentralMoments there = about_centroid(ring_moments(ring, {-20, 30}));
  CHECK(here.area == Approx(6));
  CHECK(there.xx == Approx(here.xx).margin(1e-11));
  CHECK(there.xy == Approx(here.xy).margin(1e-11));
  CHECK(there.yy == Approx(here.yy).margin(1e-11));
}

TEST_CASE("the polar moment is the same in every orientation", "[geometry][polygon]") {
  const CentralMoments upright = about_centroid(ring_moments(sample_ring, {0, 0}));
  for (const double angle : {0.1, 0.7, 2.0, 4.4}) {
    const CentralMoments m = about_centroid(ring_moments(rotated(sample_ring, angle), {0, 0}));
    CHECK(m.area == Approx(8));
    CHECK(m.xx + m.yy == Approx(upright.xx + upright.yy));
    CHECK(m.xx * m.yy - m.xy * m.xy == Approx(upright.xx * upright.yy));
  }
}

TEST_CASE("the smallest width is that of the hull, however it is turned", "[geometry][polygon]") {
  for (const double angle : {0.0, 0.3, 1.2, 3.0}) {
    CHECK(smallest_width(rotated(sample_ring, angle)) == Approx(2));
    // An equilateral triangle of side 2: its height.
    CHECK(smallest_width(rotated({{0, 0}, {2, 0}, {1, std::sqrt(3.0)}}, angle)) == Approx(std::sqrt(3.0)));
    // Concave: what the hull measures.
    CHECK(smallest_width(rotated({{0, 0}, {4, 0}, {4, 3}, {2, 0.5}, {0, 3}}, angle)) == Approx(3));
    // Collinear vertices change nothing.
    CHECK(smallest_width(rotated({{0, 0}, {2, 0}, {4, 0}, {4, 1}, {1, 1}, {0, 1}}, angle)) == Approx(1));
  }
}
