#include "conformance/boundary_arrays.hpp"
#include "conformance/pairs.hpp"
#include "contact_models/law_bench.hpp"

#include <talus/overlap/cells.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace talus;
using namespace talus::bench;

namespace {

using overlap::CellDivider;
using overlap::OverlapFinder;
using overlap::Piece;
using overlap::Point;

/// The pieces of two bodies in the frame of the first.
class Pieces {
 public:
  explicit Pieces(const std::vector<HeldBody>& bodies) : arrays_(bodies) {
    view_ = arrays_.view();
    const Vec2 offset{bodies[1].centre.x - bodies[0].centre.x, bodies[1].centre.y - bodies[0].centre.y};
    for (std::uint32_t body = 0; body < 2; ++body) {
      for (std::uint32_t p = arrays_.body_piece[body]; p < arrays_.body_piece[body + 1]; ++p) {
        of[body].emplace_back(view_, p, body == 0 ? Point{0, 0} : Point{offset.x, offset.y}, 0);
      }
    }
  }
  Pieces(const Pieces&) = delete;
  Pieces& operator=(const Pieces&) = delete;

  std::vector<Piece> of[2];

 private:
  BoundaryArrays arrays_;
  Boundaries view_;
};

double distance_to_side(const Piece& piece, std::uint32_t side, Point p) {
  const double lever = std::clamp(piece.lever(side, p), 0.0, 1.0);
  const Point a = piece.at(side), b = piece.at(piece.next(side));
  return overlap::length(p - ((1 - lever) * a + lever * b));
}

double nearest_side(const Piece& piece, Point p) {
  double nearest = 1e300;
  for (std::uint32_t k = 0; k < piece.size(); ++k) {
    if (piece.real(k)) nearest = std::min(nearest, distance_to_side(piece, k, p));
  }
  return nearest;
}

struct Found {
  std::size_t overlaps = 0, cells = 0;
  double area = 0;
};

/// Checks every overlap of two bodies with either as master.
Found check(const std::vector<HeldBody>& bodies) {
  const Pieces pieces(bodies);
  OverlapFinder finder;
  CellDivider divider;
  Found found;
  for (const Piece& a : pieces.of[0]) {
    for (const Piece& b : pieces.of[1]) {
      const overlap::Polygon& polygon = finder.find(a, b);
      if (polygon.empty()) continue;
      const double area = area_centroid(polygon).area;
      if (!(area > 0)) continue;
      ++found.overlaps;
      found.area += area;
      for (const Piece* master : {&a, &b}) {
        double sum = 0;
        divider.divide(*master, 0, polygon, [&](std::uint32_t side, const overlap::Polygon& cell) {
          ++found.cells;
          const auto region = area_centroid(cell);
          sum += region.area;
          if (!(region.area > 0)) return;
          // Nearest to its side at the centroid; where a cut is near, to within what the cut leaves open.
          const bool whole = pieces.of[master == &a ? 0 : 1].size() == 1;
          if (whole) {
            CHECK(master->depth(side, region.centroid) <= nearest_side(*master, region.centroid) + 1e-15);
          }
        });
        CHECK(std::abs(sum - area) <= 1e-12 * area);
      }
    }
  }
  return found;
}

}  // namespace

TEST_CASE("Cells are nearest to their sides and sum to the overlap", "[laws]") {
  std::vector<HeldPair> pairs = random_pairs(108);
  for (HeldPair& pair : awkward_pairs()) {
    if (pair.depth > 1e-15) pairs.push_back(std::move(pair));
  }
  for (const double depth : {1e-3, 1e-2, 0.05}) {
    pairs.push_back(saw_teeth(depth));
    pairs.push_back(body_in_notch(depth));
  }
  for (const HeldPair& pair : pairs) {
    INFO(pair.name);
    CHECK(check(pair.bodies).overlaps > 0);
  }
}

TEST_CASE("Bisectors of a short side cross inside the overlap: nothing is counted twice", "[laws]") {
  for (const double chamfer : {0.01, 0.002, 1e-4}) {
    for (const double degrees : {0.0, 10.0, 30.0, 45.0, 60.0}) {
      INFO(chamfer << " m at " << degrees << " degrees");
      CHECK(check(chamfered(chamfer, degrees, 0.03).bodies).cells >= 2);
    }
  }
}

TEST_CASE("Opposite sides of a thin plate compete for the overlap", "[laws]") {
  // The block reaches through more than half of the plate.
  const Found found = check({box(0, 0, 2, 0.01), box(0.5, 0.003, 1, 1)});
  CHECK(found.area == Approx(0.5 * 0.007).epsilon(1e-12));
  CHECK(found.cells >= 3);
}

TEST_CASE("No overlap where bodies touch", "[laws]") {
  CHECK(check({box(0, 0, 1, 1), box(0, 1, 1, 2)}).overlaps == 0);
  CHECK(check({box(0, 0, 1, 1), box(1, 1, 2, 2)}).overlaps == 0);
  CHECK(check({box(0, 0, 1, 1), box(0.3, 1, 0.6, 2)}).overlaps == 0);
}

TEST_CASE("Of a straight side with corners in it each part bounds the overlap, whichever body is first",
          "[laws]") {
  const HeldBody divided = held({{0, 0}, {1.5, 0}, {1.75, 0}, {2, 0}, {2, 1}, {0, 1}}),
                 whole = box(-1, -1, 1.8, 1e-3);
  for (const double angle : {0.0, 17.0, 171.0}) {
    for (const std::uint32_t place : {0u, 1u}) {
      INFO("turned by " << angle << " degrees, listed at " << place);
      const HeldBody turned = moved(turned_by(angle), divided), other = moved(turned_by(angle), whole);
      const Pieces pieces(place == 0 ? std::vector{turned, other} : std::vector{other, turned});
      OverlapFinder finder;
      const overlap::Polygon& common = finder.find(pieces.of[0][0], pieces.of[1][0]);
      std::vector<double> bounds(6);
      for (std::size_t i = 0; i < common.size(); ++i) {
        const overlap::Corner& corner = common[i];
        if (corner.side.body == place)
          bounds[corner.side.index] += overlap::length(common[common.next(i)].at - corner.at);
      }
      CHECK(bounds[0] == Approx(1.5));
      CHECK(bounds[1] == Approx(0.25));
      CHECK(bounds[2] == Approx(0.05));
      CHECK(overlap::area_centroid(common).area == Approx(1.8e-3));
    }
  }
}
