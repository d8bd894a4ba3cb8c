#include "blocks/generator.hpp"

#include "geometry/outlines.hpp"
#include "scene/sample.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

using namespace talus;

namespace {

constexpr double rounding = 1e-12;

bool same_shapes(const std::vector<SceneBody>& a, const std::vector<SceneBody>& b) {
  const auto same = [](Vec2 p, Vec2 q) { return p.x == q.x && p.y == q.y; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](const SceneBody& one, const SceneBody& other) {
                      return std::equal(one.outer.vertices.begin(), one.outer.vertices.end(),
                                        other.outer.vertices.begin(), other.outer.vertices.end(), same);
                    });
}

}  // namespace

TEST_CASE("a domain that nothing cuts is one block", "[blocks]") {
  const auto bodies = made("");
  REQUIRE(bodies.size() == 1);
  CHECK(bodies[0].name == "b_1");
  CHECK(area_of(bodies[0]) == 1);
}

TEST_CASE("two sets of joints cut the square into a grid, sorted by place", "[blocks]") {
  const auto bodies = made(R"("joint_sets": [{"dip": 0, "spacing": 0.5}, {"dip": 90, "spacing": 0.25}])");
  REQUIRE(bodies.size() == 8);
  for (std::size_t i = 0; i < 8; ++i) {
    INFO(i);
    const double x = 0.25 * static_cast<double>(i / 2), y = 0.5 * static_cast<double>(i % 2);
    CHECK(bodies[i].name == "b_" + std::to_string(i + 1));
    CHECK(area_of(bodies[i]) == Approx(0.125).epsilon(rounding));
    REQUIRE(bodies[i].outer.vertices.size() == 4);  // the joints that lie on the boundary add nothing
    CHECK(bodies[i].outer.vertices[0].x == Approx(x).margin(rounding));
    CHECK(bodies[i].outer.vertices[0].y == Approx(y).margin(rounding));
  }
}

TEST_CASE("oblique joints conserve the area, and T-joints leave no vertices in edges", "[blocks]") {
  const auto bodies = made(R"("joint_sets": [{"dip": 33, "spacing": 0.07, "jitter": 0.2, "seed": 3},
                              {"dip": -61, "spacing": 0.11, "persistence": 0.7, "gap": 0.05, "seed": 4}])",
                           "[[0, 0], [3, 0.5], [2.2, 2], [1.4, 0.9], [-0.3, 1.7]]");
  CHECK(bodies.size() > 100);
  const Ring domain{{0, 0}, {3, 0.5}, {2.2, 2}, {1.4, 0.9}, {-0.3, 1.7}};
  CHECK(area_sum(bodies) == Approx(signed_area(domain)).epsilon(rounding));
  for (const SceneBody& body : bodies) {
    const Ring& ring = body.outer.vertices;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()], c = ring[(i + 2) % ring.size()];
      const double cross = (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
      CHECK(std::abs(cross) > rounding * std::hypot(b.x - a.x, b.y - a.y) * std::hypot(c.x - b.x, c.y - b.y));
    }
  }
}

TEST_CASE("the seed decides what is random, and nothing else does", "[blocks]") {
  const std::string set = R"("joint_sets": [{"dip": 20, "spacing": 0.2, "jitter": 0.4, "seed": )";
  const auto first = made(set + "1}]"), again = made(set + "1}]"), other = made(set + "2}]");
  CHECK(same_shapes(first, again));
  CHECK_FALSE(same_shapes(first, other));
}

TEST_CASE("joints of neighbouring domains continue each other", "[blocks]") {
  const std::string set = R"("joint_sets": [{"dip": 0, "spacing": 0.3, "jitter": 0.4, "seed": 5}])";
  const auto left = made(set), right = made(set, "[[1, -2], [2, -2], [2, 1], [1, 1]]");
  CHECK(left.back().outer.vertices[0].y == right.back().outer.vertices[0].y);
}

TEST_CASE("a joint that ends in the rock does not cut, one that ends on another does", "[blocks]") {
  CHECK(made(R"("joints": [{"points": [[0, 0.5], [0.7, 0.5]]}])").size() == 1);
  CHECK(made(R"("joints": [{"points": [[0.2, 0.2], [0.7, 0.5]]}])").size() == 1);
  const std::string slanted = "[[0, 0], [1, 0.1], [0.7, 1.3], [-0.1, 0.9]]";
  // Ends within rounding of the slanted boundary.
  CHECK(made(R"("joints": [{"points": [[0.3, 0.03], [0.3, 1.1]]}])", slanted).size() == 2);
  const auto three =
      made(R"("joints": [{"points": [[0, 0.5], [1, 0.5]]}, {"points": [[0.5, 0.5], [0.5, 1]]}])");
  REQUIRE(three.size() == 3);
  CHECK(area_of(three[0]) == 0.25);
  CHECK(area_of(three[1]) == 0.5);
  CHECK(three[1].outer.vertices.size() == 4);  // the end of the other joint is no corner of it
}

TEST_CASE("joints that meet corners of a domain written with nine digits make no edges of rounding",
          "[blocks]") {
  // The corner (0, 0) lies on a joint of either set; the others are 1e-10 m and less off theirs.
  const auto bodies = made(R"("joint_sets": [{"dip": 25, "spacing": 1.5}, {"dip": -65, "spacing": 3}])",
                           "[[0, 0], [16.313540167, 7.607128711], [15.045685381, 10.326052072], "
                           "[-1.267854785, 2.718923361]]");
  CHECK(bodies.size() == 12);
  for (const SceneBody& body : bodies) CHECK(body.outer.vertices.size() == 4);
}

TEST_CASE("a closed joint leaves a block with a hole, and holes of the domain stay open", "[blocks]") {
  const auto bodies =
      made(R"("joints": [{"points": [[0.4, 0.4], [0.6, 0.4], [0.6, 0.6], [0.4, 0.6], [0.4, 0.4]]}])");
  REQUIRE(bodies.size() == 2);
  CHECK(area_sum(bodies) == Approx(1).epsilon(rounding));
  CHECK(bodies[0].holes.size() + bodies[1].holes.size() == 1);
  const auto open = made(R"("holes": [[[0.4, 0.4], [0.6, 0.4], [0.6, 0.6], [0.4, 0.6]]],
                            "joint_sets": [{"dip": 0, "spacing": 0.5}])");
  CHECK(open.size() == 2);
  CHECK(area_sum(open) == Approx(0.96).epsilon(rounding));
}

TEST_CASE("small blocks join the neighbour with the longest common boundary", "[blocks]") {
  // A strip of 0.1 x 1 at the right is cut at y = 0.3; what is left of it is cut at x = 0.5.
  const std::string joints =
      R"("joints": [{"points": [[0.9, 0], [0.9, 1]]}, {"points": [[0.9, 0.3], [1, 0.3]]},
                                {"points": [[0, 0.1], [0.9, 0.1]]}])";
  REQUIRE(made(joints).size() == 4);
  // The lower part of the strip (0.03 m2) meets 0.1 of its upper part, 0.1 of the left foot and 0.2 of the
  // rest.
  const auto merged = made(joints + R"(, "smallest_area": 0.05)");
  REQUIRE(merged.size() == 3);
  CHECK(area_sum(merged) == Approx(1).epsilon(rounding));
  CHECK(area_of(merged[1]) == Approx(0.81 + 0.03).epsilon(rounding));
  // A mean of 0.25 m2: 0.4 of it are 0.1 m2, which the strip's upper part (0.07) and the foot (0.09) miss,
  // too.
  CHECK(made(joints + R"(, "smallest_share": 0.4)").size() == 1);
}

TEST_CASE("blocks that are just as large as the smallest stay, wherever they lie", "[blocks]") {
  for (const double x : {0.0, 0.3, 1.0, 100.0}) {
    INFO(x);
    const std::string domain =
        fmt::format("[[{0}, {0}], [{1}, {0}], [{1}, {2}], [{0}, {2}]]", x, x + 10, x + 3);
    for (const char* limit : {R"("smallest_area": 0.3)", R"("smallest_share": 1)"}) {
      const auto bodies =
          made(fmt::format(R"("bricks": {{"width": 1, "height": 0.3, "bond": "stack"}}, {})", limit), domain);
      CHECK(bodies.size() == 100);
    }
  }
  CHECK(made(R"("joint_sets": [{"dip": 0, "spacing": 0.1}], "smallest_area": 0.05,
                "split": {"share": 1, "seed": 3})")
            .size() == 20);
}

TEST_CASE("a block that meets itself at a point gets one simple boundary, and no rock is lost", "[blocks]") {
  // Two joints cross and two more close the triangles left and right of the crossing.
  const auto crossing =
      made(R"("joints": [{"points": [[0.2, 0.2], [0.8, 0.8]]}, {"points": [[0.2, 0.8], [0.8, 0.2]]},
                                {"points": [[0.2, 0.2], [0.2, 0.8]]}, {"points": [[0.8, 0.2], [0.8, 0.8]]}])");
  REQUIRE(crossing.size() == 3);
  CHECK(area_sum(crossing) == Approx(1).epsilon(rounding));
  for (const SceneBody& body : crossing) {
    const double area = area_of(body);
    CHECK((area == Approx(0.09).epsilon(1e-3) || area == Approx(0.82).epsilon(1e-3)));
  }
  // A square on its corner stands on the lower edge, cut in two through that corner.
  const auto standing =
      made(R"("joints": [{"points": [[0.5, 0], [0.8, 0.3], [0.5, 0.6], [0.2, 0.3], [0.5, 0]]},
                                {"points": [[0.5, 0], [0.5, 0.6]]}])");
  REQUIRE(standing.size() == 3);
  CHECK(area_sum(standing) == Approx(1).epsilon(rounding));
  std::size_t halves = 0;
  for (const SceneBody& body : standing) {
    if (body.outer.vertices.size() == 4 && body.holes.empty() && area_of(body) < 0.1) ++halves;
  }
  CHECK(halves == 2);  // each half has lost its foot
}

TEST_CASE("where a corner is cut off the new edge is of the surface of its sides", "[blocks]") {
  const auto bodies = made(
      R"("joints": [{"points": [[0.2, 0.2], [0.8, 0.8], [0.8, 0.2], [0.2, 0.8], [0.2, 0.2]], "surface": "joint"}])");
  REQUIRE(bodies.size() == 3);
  for (const SceneBody& body : bodies) {
    if (area_of(body) > 0.5) continue;  // the rock around, with the outer boundary
    for (const std::uint32_t surface : body.outer.surface_class)
      CHECK(surface == body.outer.surface_class[0]);
  }
}

TEST_CASE("of corners that meet at a point the sharper one is cut off, however the drawing is turned",
          "[blocks]") {
  // About the middle of the square a tip that points at it from the left and, from the right: a notch around
  // it, and a straight side.
  using Line = std::vector<Vec2>;
  const Line tip{{0, 0}, {-0.3, 0.1}, {-0.3, -0.1}, {0, 0}};
  const Line notch{{0, 0}, {-0.2, 0.3}, {0.3, 0.3}, {0.3, -0.3}, {-0.2, -0.3}, {0, 0}};
  const Line straight{{0, 0}, {0, 0.3}, {0.3, 0.3}, {0.3, -0.3}, {0, -0.3}, {0, 0}};
  for (const Line& other : {notch, straight}) {
    const double area = signed_area(Ring(other.begin(), other.end() - 1));
    for (int turns = 0; turns < 4; ++turns) {
      INFO(turns);
      const auto drawn = [&](const Line& line) {
        std::string points;
        for (Vec2 p : line) {
          for (int i = 0; i < turns; ++i) p = {-p.y, p.x};
          points += fmt::format("{}[{}, {}]", points.empty() ? "" : ", ", 0.5 + p.x, 0.5 + p.y);
        }
        return fmt::format(R"({{"points": [{}]}})", points);
      };
      const auto bodies = made(fmt::format(R"("joints": [{}, {}])", drawn(tip), drawn(other)));
      REQUIRE(bodies.size() == 3);
      CHECK(area_sum(bodies) == Approx(1).epsilon(rounding));
      const auto whole = [&](const SceneBody& body) {
        return std::abs(area_of(body) - std::abs(area)) < 1e-12;
      };
      CHECK(std::count_if(bodies.begin(), bodies.end(), whole) == 1);
    }
  }
}

TEST_CASE(
    "blocks that touch at a corner, drawn side by side, lose as much of it as where they are closed lines",
    "[blocks]") {
  // Two lines that cross at (0.5, 0.3), but for the tenth digit: lengthened ones cross once more beside it.
  const std::vector<std::vector<Vec2>> triangles{
      {{0.5, 0.3}, {0.7, 0.22}, {0.65, 0.37}},
      {{0.5, 0.3}, {0.3199999999, 0.3719999998}, {0.3650000001, 0.2369999999}}};
  const auto point = [](Vec2 p) { return fmt::format("[{:.10f}, {:.10f}]", p.x, p.y); };
  std::string sides, closed;
  for (const auto& corners : triangles) {
    std::string around;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string from = point(corners[i]), to = point(corners[(i + 1) % 3]);
      sides += fmt::format(R"({}{{"points": [{}, {}]}})", sides.empty() ? "" : ", ", from, to);
      around += from + ", ";
    }
    closed += fmt::format(R"({}{{"points": [{}{}]}})", closed.empty() ? "" : ", ", around, point(corners[0]));
  }
  const auto drawn = made(fmt::format(R"("joints": [{}])", sides)),
             whole = made(fmt::format(R"("joints": [{}])", closed));
  REQUIRE(drawn.size() == 3);
  REQUIRE(whole.size() == 3);
  CHECK(area_sum(drawn) == Approx(1).epsilon(rounding));
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(drawn[i].outer.vertices.size() == whole[i].outer.vertices.size());
    CHECK(area_of(drawn[i]) == Approx(area_of(whole[i])).epsilon(1e-6));
  }
}

TEST_CASE("an opening keeps its corner, and a block within a block gives way twice", "[blocks]") {
  const auto open = made(R"("holes": [[[0.5, 0.5], [0.2, 0.6], [0.2, 0.4]]],
                            "joints": [{"points": [[0.5, 0.5], [0.9, 0.4], [0.9, 0.6], [0.5, 0.5]]}])");
  CHECK(area_sum(open) == Approx(0.97).epsilon(rounding));
  const auto nested = made(R"("joints": [{"points": [[0.5, 0], [0.9, 0.6], [0.1, 0.6], [0.5, 0]]},
                              {"points": [[0.5, 0], [0.6, 0.4], [0.4, 0.4], [0.5, 0]]}])");
  CHECK(nested.size() == 3);
  CHECK(area_sum(nested) == Approx(1).epsilon(rounding));
}

TEST_CASE("slivers between joints that all but coincide are merged", "[blocks]") {
  const auto bodies =
      made(R"("joints": [{"points": [[0, 0.5], [1, 0.5]]}, {"points": [[0, 0.5], [1, 0.500000001]]}])");
  REQUIRE(bodies.size() == 2);
  CHECK(area_sum(bodies) == Approx(1).epsilon(rounding));
}

TEST_CASE("bricks in running bond and in stacks", "[blocks]") {
  const auto running = made(R"("bricks": {"width": 0.5, "height": 0.25})");
  REQUIRE(running.size() == 10);  // courses of two, and of one between two halves
  CHECK(area_sum(running) == Approx(1).epsilon(rounding));
  CHECK(std::count_if(running.begin(), running.end(), [](const SceneBody& body) {
          return std::abs(area_of(body) - 0.0625) < rounding;
        }) == 4);
  CHECK(made(R"("bricks": {"width": 0.5, "height": 0.25, "bond": "stack"})").size() == 8);
  const auto apart = made(R"("bricks": {"width": 0.4, "height": 0.2, "bond": "stack", "gap": 0.1})");
  // From the lower left corner: columns at 0 and 0.5, courses at 0, 0.3, 0.6 and a cut one at 0.9.
  REQUIRE(apart.size() == 8);
  CHECK(area_sum(apart) == Approx(2 * 0.4 * (3 * 0.2 + 0.1)).epsilon(rounding));
}

TEST_CASE("Voronoi cells by count and by spacing fill the domain", "[blocks]") {
  const auto counted = made(R"("voronoi": {"count": 40, "seed": 1})");
  CHECK(counted.size() == 40);
  CHECK(area_sum(counted) == Approx(1).epsilon(rounding));
  CHECK(same_shapes(counted, made(R"("voronoi": {"count": 40, "seed": 1})")));
  CHECK(made(R"("voronoi": {"count": 1})").size() == 1);
  // No point falls into an opening, and each has a block.
  const auto around = made(
      R"("voronoi": {"count": 40, "seed": 1}, "holes": [[[0.1, 0.1], [0.9, 0.1], [0.9, 0.8], [0.1, 0.8]]])");
  CHECK(around.size() >= 40);
  CHECK(area_sum(around) == Approx(1 - 0.56).epsilon(rounding));
  const auto spaced = made(R"("voronoi": {"spacing": 0.1, "jitter": 0, "seed": 1})");
  CHECK(area_sum(spaced) == Approx(1).epsilon(rounding));
  // Inner cells are the hexagons of the grid: spacing² √3/2.
  CHECK(std::count_if(spaced.begin(), spaced.end(), [](const SceneBody& body) {
          return std::abs(area_of(body) / (0.01 * std::sqrt(0.75)) - 1) < 1e-9;
        }) > 50);
}

TEST_CASE("a share of the quadrilaterals becomes triangles, along the shorter diagonal", "[blocks]") {
  const std::string grid = R"("joint_sets": [{"dip": 45, "spacing": 0.2}, {"dip": 0, "spacing": 0.1}])";
  const auto whole = made(grid), all = made(grid + R"(, "split": {"share": 1})");
  const auto corners = [](const std::vector<SceneBody>& bodies, std::size_t count) {
    return std::count_if(bodies.begin(), bodies.end(),
                         [&](const SceneBody& body) { return body.outer.vertices.size() == count; });
  };
  const auto quadrilaterals = corners(whole, 4);
  REQUIRE(quadrilaterals > 20);
  CHECK(corners(all, 4) == 0);
  CHECK(all.size() == whole.size() + static_cast<std::size_t>(quadrilaterals));
  CHECK(area_sum(all) == Approx(1).epsilon(rounding));
  const auto some = made(grid + R"(, "split": {"share": 0.5, "seed": 1})");
  CHECK(some.size() > whole.size());
  CHECK(some.size() < all.size());
  // The rhomb's diagonals are 4 and 2: the halves lie left and right of the upright one.
  const auto halves = made(R"("split": {"share": 1})", "[[0, 0], [2, -1], [4, 0], [2, 1]]");
  REQUIRE(halves.size() == 2);
  CHECK(area_of(halves[0]) == 2);
  for (const Vec2 vertex : halves[0].outer.vertices) CHECK(vertex.x <= 2);
  CHECK(made(R"("split": {"share": 1}, "smallest_area": 0.6)").size() ==
        1);  // halves of 0.5 m2 would be small
}

TEST_CASE("no sliver is split off a block whose drawn line ends beside its corner", "[blocks]") {
  // 5e-7 m beside the corner of a domain of 20 m: the other half would be a triangle as thin as that.
  const std::string line = R"("joints": [{"points": [[0, 0], [19.9999995, 10]]}])",
                    domain = "[[0, 0], [20, 0], [20, 10], [0, 10]]";
  CHECK(made(line + R"(, "split": {"share": 1})", domain).size() == 2);
  const std::string wider = R"("joints": [{"points": [[0, 0], [19.9, 10]]}])";
  CHECK(made(wider + R"(, "split": {"share": 1})", domain).size() == 3);
}

TEST_CASE("a warning tells how much rock is left out for want of a neighbour", "[blocks]") {
  const std::string bricks = R"("bricks": {"width": 0.2, "height": 0.1, "gap": 0.01})";
  CHECK(sample::read(generator_scene(bricks)).warnings.empty());
  const Scene scene = sample::read(generator_scene(bricks + R"(, "smallest_share": 0.6)"));
  REQUIRE(scene.warnings.size() == 1);
  CHECK_THAT(scene.warnings[0], Catch::Contains("/blocks/0") && Catch::Contains("are left out"));
}

TEST_CASE("edges along named joints and sides of the domain carry their surface", "[blocks]") {
  const Scene scene = sample::read(generator_scene(
      R"("surfaces": {"base": [0]}, "joint_sets": [{"dip": 90, "spacing": 0.5, "surface": "bedding"}],
         "joints": [{"points": [[0, 0.5], [1, 0.5]]}])"));
  REQUIRE(scene.bodies.size() == 4);
  const auto surface = [&](std::size_t body, std::size_t edge) {
    return scene.surfaces[scene.bodies[body].outer.surface_class[edge]].surface;
  };
  // From the lower left corner of each: below, right, above, left.
  CHECK(surface(0, 0) == "base");
  CHECK(surface(0, 1) == "bedding");
  CHECK(surface(0, 2).empty());
  CHECK(surface(0, 3) == "bedding");  // a joint of the set runs along the side of the domain as well
  CHECK(surface(1, 0).empty());
  CHECK(surface(1, 1) == "bedding");
}

TEST_CASE("far from zero the blocks are the same", "[blocks]") {
  const std::string joints =
      R"("joints": [{"points": [[500000.3, 5000000], [500000.6, 5000001]]}, {"points": [[500000, 5000000.5], [500001, 5000000.2]]}])";
  const auto far =
      made(joints, "[[500000, 5000000], [500001, 5000000], [500001, 5000001], [500000, 5000001]]");
  REQUIRE(far.size() == 4);
  CHECK(area_sum(far) == Approx(1).epsilon(1e-8));  // a double holds 5e6 m to 1e-9 m
  for (const SceneBody& body : far) CHECK(body.outer.vertices.size() == 4);
}

TEST_CASE("a joint that lies on an edge of the domain but for rounding loses no rock", "[blocks]") {
  for (int dip = 5; dip < 90; dip += 5) {
    const double rise = 20 * std::tan(dip * std::numbers::pi / 180);
    for (const auto& [domain, outline] :
         {std::pair(Ring{{0, 0}, {20, rise}, {20, rise + 8}, {0, 8}},
                    fmt::format("[[0, 0], [20, {0}], [20, {1}], [0, 8]]", rise, rise + 8)),
          std::pair(Ring{{0, 0}, {20, rise}, {20, rise + 6}, {10, rise + 6}},
                    fmt::format("[[0, 0], [20, {0}], [20, {1}], [10, {1}]]", rise, rise + 6))}) {
      CAPTURE(dip, outline);
      const auto bodies =
          made(fmt::format(R"("joint_sets": [{{"dip": {}, "spacing": 3}}, {{"dip": {}, "spacing": 3}}])", dip,
                           dip + 90),
               outline);
      CHECK(area_sum(bodies) == Approx(signed_area(domain)).epsilon(1e-7));
      for (const SceneBody& body : bodies) CHECK(area_of(body) > 1e-6);
    }
  }
}

TEST_CASE("vertices that all but coincide where a ring closes cost no corner", "[blocks]") {
  for (const auto& [first, second] : {std::pair("45, \"spacing\": 25", "30, \"spacing\": 22.5"),
                                      std::pair("45, \"spacing\": 20", "-45, \"spacing\": 18")}) {
    CAPTURE(first, second);
    const auto bodies = made(fmt::format(R"("joint_sets": [{{"dip": {}}}, {{"dip": {}}}])", first, second),
                             "[[0, 0], [100, 0], [100, 100], [0, 100]]");
    CHECK(area_sum(bodies) == Approx(1e4).epsilon(1e-9));
    for (const SceneBody& body : bodies) {
      const Ring& ring = body.outer.vertices;
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
        CHECK(std::hypot(b.x - a.x, b.y - a.y) > 1e-9);
      }
    }
  }
}

TEST_CASE("blocks beside a seam between lines that all but coincide do not overlap", "[blocks]") {
  // Where the joints on each other cross the seam of 3 mm, corners of it lie 1e-9 m off its sides.
  const auto bodies = made(
      R"("joints": [{"points": [[-286.75721130154716, -93.1144551966012], [262.6403447021895, 148.05421079697487]]},
                              {"points": [[-286.7584171448771, -93.11170820882118], [262.63913885885955, 148.0569577847549]]},
                              {"points": [[26.872848822480243, -10], [169.48674738744654, 120]]},
                              {"points": [[26.872848822, -10], [169.486747387, 120]]}])",
      "[[0, 0], [200, 0], [200, 40], [140, 110], [0, 110]]");
  CHECK(bodies.size() == 6);
  // A side of up to 200 m may leave out what is 1e-10 of the size off, 2e-8 m.
  CHECK(area_sum(bodies) == Approx(200 * 110 - 60 * 70 / 2).margin(200 * 2e-8));
}
