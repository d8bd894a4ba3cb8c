#include "geometry/straight_beyond.hpp"

#include "conformance/boundary_arrays.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace talus;
using namespace talus::conformance;

TEST_CASE("a side that a cut ends on goes on past it, and others do not", "[geometry]") {
  // A cut goes down from the bottom of each of two notches, or straight to the other.
  const HeldBody body = held({{0, 0}, {9, 0}, {9, 4}, {6, 4}, {5, 2}, {4, 4}, {3, 1.5}, {2, 4}, {0, 4}});
  REQUIRE(body.pieces.size() > 1);
  const BoundaryArrays arrays({body});
  const Boundaries boundaries = arrays.view();
  REQUIRE(boundaries.straight_beyond != nullptr);
  // All that is below has the length of the base, however it is cut.
  std::size_t parts = 0;
  for (std::size_t piece = 0; piece + 1 < arrays.piece_start.size(); ++piece) {
    for (std::uint32_t c = arrays.piece_start[piece]; c < arrays.piece_start[piece + 1]; ++c) {
      const BoundaryCorner& side = arrays.corners[c];
      if (side.surface == internal_side) continue;
      const double before = boundaries.straight_beyond[4 * c] * side.length,
                   after = boundaries.straight_beyond[4 * c + 1] * side.length;
      const Vec2 start{arrays.reference[c].x + body.centre.x, arrays.reference[c].y + body.centre.y};
      CAPTURE(start.x, start.y, side.length);
      if (std::abs(start.y) < 1e-12 && side.tangent_x > 0.999) {
        ++parts;
        CHECK(before == Approx(start.x).margin(1e-12));
        CHECK(before + side.length + after == Approx(9).epsilon(1e-12));
      } else if (std::abs(start.y - 4) < 1e-12 && side.tangent_x < -0.999) {
        CHECK(before == 0);
        CHECK(after == 0);
      }
    }
  }
  CHECK(parts > 1);
}

TEST_CASE("where no body is cut nothing is told of cuts", "[geometry]") {
  CHECK(BoundaryArrays({box(0, 0, 1, 1), box(2, 0, 3, 1)}).view().straight_beyond == nullptr);
  const BoundaryArrays some(
      {box(0, 0, 1, 1), held({{0, 0}, {2, 0}, {2, 2}, {1, 0.5}, {0, 2}}), box(4, 0, 5, 1)});
  CHECK(some.straight_beyond.size() == 4 * some.corners.size());
}

TEST_CASE("an edge spans what is beyond a bend that turns inwards, less of it the more it turns",
          "[geometry]") {
  constexpr double degree = 3.14159265358979323846 / 180;
  for (const double turn : {0.5, 10.0, 30.0, 60.0}) {
    INFO(turn << " degrees");
    // A floor that rises from the origin on, and before it falls to the left of -1: that bend is outwards.
    const HeldBody body =
        held({{-3, -2}, {3, -2}, {3, 3 * std::tan(turn * degree)}, {0, 0}, {-1, 0}, {-3, -0.5}});
    const BoundaryArrays arrays({body});
    const double weight = std::max(0.0, std::cos(2 * turn * degree));
    int seen = 0;
    for (std::uint32_t c = 0; c < arrays.corners.size(); ++c) {
      const BoundaryCorner& side = arrays.corners[c];
      if (side.surface == internal_side) continue;
      const Vec2 start{arrays.reference[c].x + body.centre.x, arrays.reference[c].y + body.centre.y};
      const double* beyond = &arrays.straight_beyond[4 * c];
      CAPTURE(start.x, start.y);
      if (std::abs(start.x) < 1e-12 && std::abs(start.y) < 1e-12) {
        CHECK(beyond[2] * side.length == Approx(weight * 3 / std::cos(turn * degree)).margin(1e-12));
        CHECK(beyond[3] == 0);
        ++seen;
      }
      if (std::abs(start.x - 3) < 1e-12 && side.tangent_x < 0) {
        CHECK(beyond[3] * side.length == Approx(weight).margin(1e-12));
        ++seen;
      }
    }
    CHECK(seen == 2);
  }
}
