#include "recorded_cover.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <set>
#include <utility>

using namespace talus::covered;

namespace {

const double row_height = std::sqrt(3.0) / 2;
const double full = row_height;  // ∫ w dA over a hexagon of size 1, m²

/// Reaches beyond the lattice lines on every side.
DrawnBody overhanging(double e = 1e-6) {
  return DrawnBody({{{-e, -e}, {4 + e, -e}, {4 + e, 4 * row_height + e}, {-e, 4 * row_height + e}}});
}

std::size_t poor_patches(const RecordedCover& cover, double share) {
  std::size_t count = 0;
  for (const double sum : row_sums(cover)) count += sum < share * full ? 1 : 0;
  return count;
}

/// Who follows whom, by places: as often as it is there in the mirror image of `other` (x to -x).
bool mirrors(const RecordedCover& one, const RecordedCover& other) {
  const auto places = [](const RecordedCover& cover, double sign) {
    std::map<std::pair<long, long>, std::set<std::pair<long, long>>> result;
    const auto place = [&](std::uint32_t patch) {
      const Point star = cover.stars[patch];
      return std::pair{std::lround(sign * star.x * 1e6), std::lround(star.y * 1e6)};
    };
    for (const Steadied& steadied : cover.steadied) {
      for (const std::uint32_t to : steadied.to) result[place(steadied.patch)].insert(place(to));
    }
    return result;
  };
  return places(one, 1) == places(other, -1);
}

DrawnBody plate(double half_width, double half_height) {
  return DrawnBody({{{-half_width, -half_height},
                     {half_width, -half_height},
                     {half_width, half_height},
                     {-half_width, half_height}}});
}

}  // namespace

TEST_CASE("merging leaves no free patch with little of the body", "[plugins][hexagonal]") {
  const DrawnBody body = overhanging();
  const RecordedCover cover = lay(body, {1, {0, 0}, 0, merge, 0.1});
  check_cover(body, cover, 1);
  REQUIRE(poor_patches(cover, 1e-5) > 0);
  REQUIRE(cover.steadied.size() == poor_patches(cover, 0.1));

  const std::vector<double> sums = row_sums(cover);
  for (const Steadied& one : cover.steadied) {
    CHECK(sums[one.patch] < 0.1 * full);
    CHECK(std::isinf(one.inertia_area));
    // Σ w d_to of a linear field is its value at the star point.
    const auto field = [](Point at) { return 0.3 + 1.7 * at.x - 2.9 * at.y; };
    double followed = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(sums[one.to[k]] >= 0.1 * full);
      followed += one.weights[k] * field(cover.stars[one.to[k]]);
    }
    CHECK(followed == Approx(field(cover.stars[one.patch])).epsilon(1e-11));
    // Nearby: a neighbour of the star point, not farther than two sides.
    for (const std::uint32_t to : one.to) CHECK(distance(cover.stars[to], cover.stars[one.patch]) < 2.01);
  }
}

TEST_CASE("mass scaling gives a patch the inertia that it lacks", "[plugins][hexagonal]") {
  const DrawnBody body = overhanging();
  const RecordedCover cover = lay(body, {1, {0, 0}, 0, mass_scale, 0.1});
  check_cover(body, cover, 1);
  REQUIRE(cover.steadied.size() == poor_patches(cover, 0.1));
  REQUIRE(!cover.steadied.empty());
  const std::vector<double> sums = row_sums(cover);
  for (const Steadied& one : cover.steadied) {
    CHECK(sums[one.patch] + one.inertia_area == Approx(0.1 * full).epsilon(1e-12));
  }
}

TEST_CASE("slivers are left alone by choice, and steadied below the share that is asked for",
          "[plugins][hexagonal]") {
  const DrawnBody body = overhanging(1e-4);
  CHECK(lay(body, {1, {0, 0}, 0, keep, 0.1}).steadied.empty());
  CHECK(lay(body, {1, {0, 0}, 0, merge, 0}).steadied.empty());
  CHECK(lay(body, {1, {0, 0}, 0, merge, 0.3}).steadied.size() >
        lay(body, {1, {0, 0}, 0, merge, 0.1}).steadied.size());
}

TEST_CASE("what a patch follows is the same at any size of the body, turned and shifted with it",
          "[plugins][hexagonal]") {
  const auto followed = [](double scale, double angle, double shift, auto treatment) {
    const double turn = angle * std::acos(-1.0) / 180, s = 0.355 * scale;
    std::vector<Point> ring;
    for (const Point corner : {Point{-s, -s}, Point{s, -s}, Point{s, s}, Point{-s, s}})
      ring.push_back({corner.x * std::cos(turn) - corner.y * std::sin(turn) + shift,
                      corner.x * std::sin(turn) + corner.y * std::cos(turn) - shift});
    return lay(DrawnBody({ring}), {0.2 * scale, {shift, -shift}, 17.0 + angle, treatment, 0.1}).steadied;
  };
  for (const auto treatment : {merge, mass_scale}) {
    for (int i = 0; i < 30; ++i) {
      const double angle = 2.03 * i;
      const auto one = followed(1, angle, 0, treatment), other = followed(3.3, angle, 0, treatment),
                 shifted = followed(1, angle, 7.7, treatment);
      REQUIRE(other.size() == one.size());
      REQUIRE(shifted.size() == one.size());
      for (std::size_t k = 0; k < one.size(); ++k) {
        CHECK(other[k].to == one[k].to);
        CHECK(shifted[k].to == one[k].to);
      }
    }
  }
}

TEST_CASE("neither side of a body that is its own mirror image is treated otherwise",
          "[plugins][hexagonal]") {
  for (const auto treatment : {merge, mass_scale}) {
    const RecordedCover cover = lay(plate(0.5, 0.5), {0.1, {0.05, 0}, 0, treatment, 0.1});
    REQUIRE(cover.steadied.size() > 10);
    CHECK(mirrors(cover, cover));
  }
}

TEST_CASE("patches that compete for an element do so in a mirror image, too", "[plugins][hexagonal]") {
  // Coarse: whom a patch follows often would lose more than half, and who asks first decides.
  for (const auto treatment : {merge, mass_scale}) {
    for (int i = 0; i < 40; ++i) {
      const double half_width = 0.9215 - 0.007 * i, size = 0.508 - 0.005 * i;
      const DrawnBody body = plate(half_width, 0.134);
      const RecordedCover one = lay(body, {size, {0, 0}, 17, treatment, 0.1}),
                          other = lay(body, {size, {0, 0}, -17, treatment, 0.1});
      CAPTURE(i);
      CHECK(mirrors(one, other));
    }
  }
}

TEST_CASE("a weight that is zero but for rounding takes nothing of a patch", "[plugins][hexagonal]") {
  const DrawnBody body(
      {{{3.881053, 3.286199}, {2.079116, 2.899323}, {2.118947, 2.713801}, {3.920884, 3.100677}}}),
      mirrored(
          {{{-3.881053, 3.286199}, {-3.920884, 3.100677}, {-2.118947, 2.713801}, {-2.079116, 2.899323}}});
  const RecordedCover one = lay(body, {0.467, body.centroid(), 0, merge, 0.1}),
                      other = lay(mirrored, {0.467, mirrored.centroid(), 0, merge, 0.1});
  CHECK(one.steadied.size() == 4);
  CHECK(mirrors(one, other));
}

TEST_CASE("a patch follows its own part of the body only", "[plugins][hexagonal]") {
  // Cut along a line 1e-6 above the lattice: what the upper part has of the row_height below is a sliver,
  // right above good elements of the other part.
  const DrawnBody body({{{0, 0}, {4, 0}, {4, 4 * row_height}, {0, 4 * row_height}}},
                       {{{-1, 2 * row_height - 1e-6}, {5, 2 * row_height - 1e-6}}});
  const RecordedCover cover = lay(body, {1, {0, 0}, 0, merge, 0.1});
  check_cover(body, cover, 1);
  REQUIRE(cover.parts() == 2);

  const double middle = 2 * row_height - body.centroid().y - 1e-6;
  std::vector<int> upper(cover.stars.size(), -1);
  for (const auto& element : cover.elements) {
    const auto m = moments_of(element.rings);
    for (const std::uint32_t patch : element.patch) upper[patch] = m.y / m.area > middle ? 1 : 0;
  }
  std::size_t of_upper = 0;
  for (const Steadied& one : cover.steadied) {
    for (const std::uint32_t to : one.to) CHECK(upper[to] == upper[one.patch]);
    of_upper += upper[one.patch] == 1 ? 1 : 0;
  }
  // The five vertices of the row_height below that the upper part has nothing of but the sliver (at −0.5
  // … 4.5, six).
  CHECK(of_upper >= 5);
}

TEST_CASE("where no patch has much of the body, all are left free", "[plugins][hexagonal]") {
  const DrawnBody body({{{0, 0}, {0.2, 0}, {0.2, 0.1}, {0, 0.1}}});
  const RecordedCover cover = lay(body, {1, {-0.3, -0.2}, 0, merge, 0.1});
  check_cover(body, cover, 1);
  CHECK(cover.steadied.empty());
  CHECK(cover.elements.size() == 1);
}

TEST_CASE("a crowd of slivers never makes a mass negative", "[plugins][hexagonal]") {
  // A comb of thin teeth on a bar: many patches that look for the same few targets.
  Line comb{{0, -2.2}, {9.1, -2.2}};
  for (int i = 9; i >= 0; --i) {
    comb.push_back({i + 0.1, 0.05});
    comb.push_back({i + 0.1, 3.3});
    comb.push_back({i + 0.05, 3.3});
    comb.push_back({i + 0.05, 0.05});
  }
  comb.back() = {0, 0.05};
  comb[comb.size() - 2] = {0, 3.3};
  const DrawnBody body({comb});
  for (const double share : {0.02, 0.1, 0.3, 0.5}) {
    for (const double offset : {0.0, 0.13, 0.41, 0.77}) {
      const RecordedCover cover = lay(body, {1, {offset, offset}, 0, merge, share});
      check_cover(body, cover, 1);
      CHECK(!cover.steadied.empty());
    }
  }
}
