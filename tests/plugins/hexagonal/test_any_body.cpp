#include "recorded_cover.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace talus::covered;

namespace {

using std::numbers::pi;

using Random = std::mt19937_64;

double uniform(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

/// A ring around its middle that is no further than `radius` from it, and mostly not convex.
Line star_shaped(Random& random, int corners, double radius, Point centre) {
  Line ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * pi * (i + uniform(random, 0, 0.7)) / corners;
    const double reach = radius * uniform(random, 0.5, 1);
    ring.push_back({centre.x + reach * std::cos(angle), centre.y + reach * std::sin(angle)});
  }
  return ring;
}

Point anywhere(Random& random, double reach) {
  return {uniform(random, -reach, reach), uniform(random, -reach, reach)};
}

DrawnBody random_body(Random& random) {
  std::vector<Line> rings{star_shaped(random, 6 + static_cast<int>(random() % 20), 5, {0, 0})};
  if (random() % 2 == 0) {
    const double radius = std::pow(10.0, uniform(random, -2, 0));
    rings.push_back(reversed(star_shaped(random, 3 + static_cast<int>(random() % 9), radius, {0.2, -0.1})));
  }
  std::vector<Line> lines(random() % 5);
  for (Line& line : lines) {
    line.push_back(anywhere(random, 6));
    for (std::uint64_t more = 1 + random() % 3; more > 0; --more) line.push_back(anywhere(random, 6));
  }
  return DrawnBody(rings, lines);
}

bool cuts_between(const DrawnBody& body, Point p, Point q) {
  const auto crossed = [&](const Line& line, bool closed) {
    for (std::size_t i = 0; i + (closed ? 0 : 1) < line.size(); ++i) {
      if (segments_cross(p, q, line[i], line[(i + 1) % line.size()])) return true;
    }
    return false;
  };
  return std::any_of(body.rings.begin(), body.rings.end(),
                     [&](const Line& ring) { return crossed(ring, true); }) ||
         std::any_of(body.lines.begin(), body.lines.end(),
                     [&](const Line& line) { return crossed(line, false); });
}

std::size_t element_around(const RecordedCover& cover, Point at) {
  std::size_t found = cover.elements.size();
  for (std::size_t e = 0; e < cover.elements.size(); ++e) {
    if (!is_in(cover.elements[e].rings, at)) continue;
    REQUIRE(found == cover.elements.size());  // elements do not overlap
    found = e;
  }
  return found;
}

/// Points that see each other are carried by the same patches, wherever their triangles share a vertex.
int check_connections(Random& random, const DrawnBody& body, const RecordedCover& cover, double size) {
  int checked = 0;
  for (int i = 0; i < 60; ++i) {
    const Point p = anywhere(random, 5), step = anywhere(random, size), q{p.x + step.x, p.y + step.y};
    if (!is_in(body.rings, p) || cuts_between(body, p, q)) continue;
    const std::size_t at_p = element_around(cover, p), at_q = element_around(cover, q);
    REQUIRE(at_p < cover.elements.size());
    REQUIRE(at_q < cover.elements.size());
    for (const std::uint32_t m : cover.elements[at_p].patch) {
      for (const std::uint32_t n : cover.elements[at_q].patch) {
        if (distance(cover.stars[m], cover.stars[n]) < size / 2) REQUIRE(m == n);
      }
    }
    ++checked;
  }
  return checked;
}

/// Outer arc and back along the inner one.
Line arch(int corners, double inner, double outer) {
  Line ring;
  const int each = corners / 2;
  for (int i = 0; i < each; ++i) {
    const double angle = pi * i / (each - 1);
    ring.push_back({outer * std::cos(angle), outer * std::sin(angle)});
  }
  for (int i = each; i-- > 0;) {
    const double angle = pi * i / (each - 1);
    ring.push_back({inner * std::cos(angle), inner * std::sin(angle)});
  }
  return ring;
}

}  // namespace

TEST_CASE("covers fill an arch and a disc, and count the parts that lines cut off", "[plugins][hexagonal]") {
  for (const double size : {3.0, 1.0, 0.31, 0.1}) {
    for (const double angle : {0.0, 12.0}) {
      const DrawnBody whole({arch(40, 4, 5)});
      check_cover(whole, lay(whole, {size, {0.1, 0.2}, angle}), size);
      CHECK(lay(whole, {size, {0.1, 0.2}, angle}).parts() == 1);

      const DrawnBody cut({arch(40, 4, 5)}, {{{0, 0}, {0, 6}}, {{0, 0}, {5, 4}}, {{-5, 4}, {0, 0}}});
      const RecordedCover pieces = lay(cut, {size, {0.1, 0.2}, angle});
      check_cover(cut, pieces, size);
      CHECK(pieces.parts() == 4);

      const DrawnBody disc({regular_polygon(64, 2, {9, 9})}, {{{9, 9}, {12, 10}}});
      const RecordedCover slit = lay(disc, {size, {9, 9}, angle});
      check_cover(disc, slit, size);
      CHECK(slit.parts() == 1);
    }
  }
}

TEST_CASE("covers of bodies of any shape keep all their promises", "[plugins][hexagonal]") {
  Random random(1);
  int checked = 0;
  for (int i = 0; i < 200; ++i) {
    CAPTURE(i);
    const DrawnBody body = random_body(random);
    const double size = std::pow(10.0, uniform(random, -0.8, 1.3));
    Settings settings{size, anywhere(random, size), uniform(random, -180, 180)};
    settings.slivers = static_cast<double>(random() % 3);
    const RecordedCover cover = lay(body, settings);
    check_cover(body, cover, size);
    checked += check_connections(random, body, cover, size);
  }
  CHECK(checked > 2000);
}

TEST_CASE("covers stand near coincidences of all sizes", "[plugins][hexagonal]") {
  // Corners of the body and ends of discontinuities lie on lattice vertices and lines, or beside them by
  // anything from the last digit to a thousandth.
  Random random(2);
  const double row = std::sqrt(3.0) / 2;
  const auto nudge = [&] {
    return random() % 3 == 0 ? 0 : std::pow(10.0, uniform(random, -16, -3)) * (random() % 2 == 0 ? 1 : -1);
  };
  const auto vertex = [&](int a, int b) { return Point{a + b / 2.0 + nudge(), b * row + nudge()}; };
  for (int i = 0; i < 400; ++i) {
    CAPTURE(i);
    const Line ring{vertex(0, 0), vertex(4, 0), vertex(4, 2), vertex(0, 4), vertex(0, 2)};
    std::vector<Line> lines;
    for (std::uint64_t count = random() % 4; count > 0; --count) {
      const auto end = [&] { return vertex(static_cast<int>(random() % 5), static_cast<int>(random() % 5)); };
      lines.push_back({end(), end()});
      if (random() % 2 == 0) lines.push_back(lines.back());
    }
    const DrawnBody body({ring}, lines);
    // The coarsest tolerance is 1.2e-7 of the size, and a line may be bent more than once.
    check_cover(body, lay(body, {1, {nudge(), nudge()}}), 1, 5e-7);
  }
}

TEST_CASE("the same body gives the same cover to the last bit", "[plugins][hexagonal]") {
  Random random(3);
  const DrawnBody body = random_body(random);
  const RecordedCover first = lay(body, {0.3, {0.1, 0}, 5}), second = lay(body, {0.3, {0.1, 0}, 5});
  REQUIRE(first.elements.size() == second.elements.size());
  REQUIRE(first.steadied.size() == second.steadied.size());
  for (std::size_t e = 0; e < first.elements.size(); ++e) {
    REQUIRE(first.elements[e].patch == second.elements[e].patch);
    REQUIRE(first.elements[e].rings.size() == second.elements[e].rings.size());
    for (std::size_t r = 0; r < first.elements[e].rings.size(); ++r) {
      const Line &p = first.elements[e].rings[r], &q = second.elements[e].rings[r];
      REQUIRE(std::equal(p.begin(), p.end(), q.begin(), q.end(),
                         [](Point m, Point n) { return m.x == n.x && m.y == n.y; }));
    }
  }
}

TEST_CASE("a lattice shifted by whole triangles is the same lattice", "[plugins][hexagonal]") {
  const DrawnBody body({regular_polygon(7, 2, {0.3, 0.2})});
  const RecordedCover near = lay(body, {0.5, {0, 0}}), far = lay(body, {0.5, {500, 0}});
  CHECK(near.elements.size() == far.elements.size());
  CHECK(near.stars.size() == far.stars.size());
  check_cover(body, far, 0.5);
}

TEST_CASE("bodies that cannot be covered are refused in words", "[plugins][hexagonal]") {
  const auto words = [](const DrawnBody& body, double size) {
    const RecordedCover cover = lay(body, {size});
    CHECK(cover.stars.empty());
    CHECK(cover.elements.empty());
    return cover.refusal;
  };
  const DrawnBody square({{{0, 0}, {1, 0}, {1, 1}, {0, 1}}});
  CHECK(words(square, 1e-4) ==
        "a lattice of size 0.0001 m needs some 2.3e+08 triangles, more than 5e+06; take a larger size");
  CHECK(words(square, 1e-300).find("take a larger size") != std::string::npos);
  CHECK(
      words(square, 1e10) ==
      "vertices 0 and 1 of the outline are 1 m apart, too close for a lattice of size 1e+10 m; join them or "
      "take a smaller size");
  CHECK(words(square, 1e12) == "nothing of the body is left on so large a lattice; take a smaller size");
}
