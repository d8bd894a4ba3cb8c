#include "recorded_cover.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace talus::covered;

namespace {

using std::numbers::pi;
const double row = std::sqrt(3.0) / 2;  // height of a row of triangles of size 1

struct Counts {
  std::size_t elements, patches, loops, parts;
  double cut_length;  ///< of the boundary beyond the outline's length
};

/// Lattice of size 1 with a vertex at the origin, all of it, and the same turned, shrunk and drawn elsewhere.
void check_counts(const std::vector<Line>& rings, const std::vector<Line>& lines, const Counts& expected) {
  for (const double angle : {0.0, 37.0, 60.0, -111.3}) {
    for (const double scale : {1.0, 1e-5, 3e7}) {
      const Point shift{17.3 * scale, -4.1 * scale};
      const auto drawn = [&](const std::vector<Line>& all) {
        std::vector<Line> result = turned(all, angle * pi / 180);
        for (Line& line : result) {
          for (Point& p : line) p = {scale * p.x + shift.x, scale * p.y + shift.y};
        }
        return result;
      };
      const DrawnBody body(drawn(rings), drawn(lines));
      const RecordedCover cover = lay(body, {scale, shift, angle, keep});
      CAPTURE(angle, scale);
      REQUIRE(cover.refusal == "");
      CHECK(cover.elements.size() == expected.elements);
      CHECK(cover.stars.size() == expected.patches);
      CHECK(cover.loops.size() == expected.loops);
      CHECK(cover.parts() == expected.parts);
      CHECK(boundary_length(cover) / scale ==
            Approx(outline_length(body) / scale + expected.cut_length).epsilon(1e-8));
      check_cover(body, cover, scale);
    }
  }
}

/// Two rows of triangles: the bottom one has vertices at 0, 1 … 4, the middle line at −0.5, 0.5 … 4.5.
const Line rectangle{{0, 0}, {4, 0}, {4, 2 * row}, {0, 2 * row}};
const Line hexagon = regular_polygon(6, 1);

}  // namespace

TEST_CASE("a rectangle of two rows has 2 (4 + 5) elements and 5 + 6 + 5 patches", "[plugins][hexagonal]") {
  check_counts({rectangle}, {}, {18, 16, 1, 1, 0});

  // Four sides at the bottom and at the top, two at the left and at the right.
  const DrawnBody body({rectangle});
  const RecordedCover cover = lay(body, {1, {0, 0}, 0, keep});
  REQUIRE(cover.loops.size() == 1);
  CHECK(cover.loops[0].size() == 12);
}

TEST_CASE("a lattice vertex on each corner of a triangle of side 4: 16 elements, 15 patches",
          "[plugins][hexagonal]") {
  check_counts({{{0, 0}, {4, 0}, {2, 4 * row}}}, {}, {16, 15, 1, 1, 0});
  check_counts({hexagon}, {}, {6, 7, 1, 1, 0});
}

TEST_CASE("a body cut through by a discontinuity falls into two parts", "[plugins][hexagonal]") {
  // Half way up the lower row: its 9 elements and all patches of its two lines of vertices exist twice.
  check_counts({rectangle}, {{{-1, row / 2}, {5, row / 2}}}, {27, 27, 2, 2, 8});
  check_counts({rectangle}, {{{0, row / 2}, {4, row / 2}}}, {27, 27, 2, 2, 8});
  check_counts({rectangle}, {{{4, row / 2}, {1.3, row / 2}, {0, row / 2}}}, {27, 27, 2, 2, 8});
  // The same discontinuity twice, partly a third time.
  check_counts(
      {rectangle},
      {{{-1, row / 2}, {5, row / 2}}, {{5, row / 2}, {-1, row / 2}}, {{3.1, row / 2}, {0.3, row / 2}}},
      {27, 27, 2, 2, 8});
  // Along the middle line of the lattice: the elements stay whole, its 6 vertices carry two patches each.
  check_counts({rectangle}, {{{-1, row}, {5, row}}}, {18, 22, 2, 2, 8});
}

TEST_CASE("a discontinuity that ends within an element cuts up to that element", "[plugins][hexagonal]") {
  // Half way up the lower row and to x = 2.1, the element around it begins at 1.75. Cut: 4 elements, and the
  // patches at 0, 1, −0.5 and 0.5. Those at 1.5 and 2 hold together around the tip.
  check_counts({rectangle}, {{{0, row / 2}, {2.1, row / 2}}}, {22, 20, 1, 1, 3.5});
  check_counts({rectangle}, {{{2.1, row / 2}, {-0.5, row / 2}}}, {22, 20, 1, 1, 3.5});
  // Just to the side of the element: no difference.
  check_counts({rectangle}, {{{0, row / 2}, {1.75, row / 2}}}, {22, 20, 1, 1, 3.5});
  // Through one triangle within a body, with both ends in its neighbours: no patch is split.
  check_counts({regular_polygon(6, 3)}, {{{0.1, row / 2}, {0.9, row / 2}}}, {54, 37, 1, 1, 0});
  // From below into one triangle: its side at the bottom stays one.
  const DrawnBody nicked({rectangle}, {{{0.5, -1}, {0.5, 0.3}}});
  const RecordedCover cover = lay(nicked, {1, {0, 0}, 0, keep});
  REQUIRE(cover.loops.size() == 1);
  CHECK(cover.loops[0].size() == 12);
  // An island of a discontinuity in one triangle.
  check_counts({rectangle}, {{{1.4, 0.2}, {1.6, 0.3}}}, {18, 16, 1, 1, 0});
}

TEST_CASE("a discontinuity along the lattice opens only where a patch is split", "[plugins][hexagonal]") {
  // From the left along the middle line, to the vertex at 1.5 and half a side farther. The vertices at −0.5
  // and 0.5 are split, the one at 1.5 is not.
  check_counts({rectangle}, {{{0, row}, {1.5, row}}}, {18, 18, 1, 1, 3});
  check_counts({rectangle}, {{{0, row}, {2, row}}}, {18, 18, 1, 1, 3});
  // Within the body: between two vertices nothing opens, over three the middle one is split.
  check_counts({rectangle}, {{{1.5, row}, {2.5, row}}}, {18, 16, 1, 1, 0});
  check_counts({rectangle}, {{{0.5, row}, {2.5, row}}}, {18, 17, 2, 1, 4});
}

TEST_CASE("crossing discontinuities leave four parts", "[plugins][hexagonal]") {
  // Through the vertex in the middle: each quarter has a triangle and a half, and four patches.
  check_counts({hexagon}, {{{-2, 0}, {2, 0}}, {{0, -2}, {0, 2}}}, {8, 16, 4, 4, 4 + 4 * row});
  // Within the only triangle of a body: four elements with patches of their own.
  check_counts({{{0, 0}, {1, 0}, {0.5, row}}}, {{{-1, 0.3}, {2, 0.3}}, {{0.45, -1}, {0.45, 1}}},
               {4, 12, 4, 4, 2 * (1 - 0.3 / row) + 2 * 0.45 * 2 * row});
}

TEST_CASE("discontinuities that meet in a T leave three parts", "[plugins][hexagonal]") {
  check_counts({hexagon}, {{{-2, 0}, {2, 0}}, {{0, 0}, {0, 2}}}, {7, 13, 3, 3, 4 + 2 * row});
  // Below: 9 elements and 11 patches. Above, on either side: 10 elements, 3 + 4 + 3 patches.
  check_counts({rectangle}, {{{-1, row / 2}, {5, row / 2}}, {{2, row / 2}, {2, 2 * row}}},
               {29, 31, 3, 3, 8 + 3 * row});
}

TEST_CASE("holes are left out of the elements", "[plugins][hexagonal]") {
  const Line small = reversed({{0.4, 0.2}, {0.6, 0.2}, {0.5, 0.4}});
  check_counts({hexagon, small}, {}, {6, 7, 2, 1, 0});
  const RecordedCover cover = lay(DrawnBody({hexagon, small}), {1, {0, 0}, 0, keep});
  std::size_t rings = 0;
  for (const auto& element : cover.elements) rings += element.rings.size();
  CHECK(rings == 7);

  // From the hole to the outline within one triangle: the material holds together around the hole.
  check_counts({hexagon, small}, {{{0.5, 0.3}, {0.9, 0.6}}}, {6, 7, 2, 1, 0});
  // Around the vertex in the middle: its patch is a ring.
  check_counts({hexagon, reversed(regular_polygon(6, 0.5))}, {}, {6, 7, 2, 1, 0});
  // The ring cut once on the right, along the lattice: all patches hold together the other way round.
  check_counts({hexagon, reversed(regular_polygon(6, 0.5))}, {{{0, 0}, {2, 0}}}, {6, 8, 1, 1, 1});
  // Sides of the hole on sides of the lattice: the vertex in the middle is gone.
  check_counts({regular_polygon(6, 2), reversed(hexagon)}, {}, {18, 18, 2, 1, 0});
  // So large that it takes whole triangles with it, and cells of the lattice that nothing passes through.
  check_counts({regular_polygon(6, 8), reversed(regular_polygon(6, 7))}, {}, {90, 90, 2, 1, 0});
}

TEST_CASE("a hole that shares a part of a side with the outline is a notch", "[plugins][hexagonal]") {
  const Line hole{{1.2, 0}, {1.2, 1.3}, {2.9, 1.3}, {2.9, 0}};
  const Line notch{{0, 0}, {1.2, 0}, {1.2, 1.3}, {2.9, 1.3}, {2.9, 0}, {4, 0}, {4, 2 * row}, {0, 2 * row}};
  for (const double angle : {0.0, 90.0, 180.0, 270.0}) {
    CAPTURE(angle);
    const DrawnBody body(turned({rectangle, hole}, angle * pi / 180));
    const DrawnBody notched(turned({notch}, angle * pi / 180));
    const RecordedCover cover = lay(body, {1, {0, 0}, 0, keep}), same = lay(notched, {1, {0, 0}, 0, keep});
    check_cover(notched, same, 1);
    CHECK(cover.refusal == "");
    CHECK(cover.elements.size() == same.elements.size());
    CHECK(cover.stars.size() == same.stars.size());
    CHECK(cover.loops.size() == 1);
    CHECK(boundary_length(cover) == Approx(outline_length(notched)));
  }
}

TEST_CASE("what does not concern a body changes nothing", "[plugins][hexagonal]") {
  const Counts whole{18, 16, 1, 1, 0};
  check_counts({rectangle}, {{{-3, -1}, {7, -1}}}, whole);
  check_counts({rectangle}, {{{-1e5, -1e5}, {-1e5, 1e5}}}, whole);
  check_counts({rectangle}, {{{-1, 0}, {3, 0}}, {{4, 0.3}, {4, 5}}}, whole);
  check_counts({rectangle}, {{{2, -1}, {2, 0}}, {{1, 2 * row}, {1, 3}}}, whole);
}

TEST_CASE("parts of a triangle on both sides of a notch share their element", "[plugins][hexagonal]") {
  // The notch ends at height 0.9 row in the triangle that stands on [2, 3]: its two lower corners hold
  // together over the tip, so do all three patches.
  const Line notched{{0, 0}, {2.4, 0}, {2.5, 0.9 * row}, {2.6, 0}, {4, 0}, {4, 2 * row}, {0, 2 * row}};
  check_counts({notched}, {}, {18, 16, 1, 1, 0});
}
