#include "blocks/generator.hpp"
#include "scene/sample.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

using namespace talus;
using Catch::Matchers::Contains;

namespace {

const std::string slope = "[[0, 0], [500, 0], [500, 500], [0, 500]]";
const std::string ten_metres = "[[0, 0], [10, 0], [10, 10], [0, 10]]";

Vec2 going(Vec2 from, double degrees, double length) {
  const double angle = degrees * (std::numbers::pi / 180);
  return {from.x + length * std::cos(angle), from.y + length * std::sin(angle)};
}

std::string joint(Vec2 from, Vec2 to, const std::string& surface) {
  return fmt::format(R"({{"points": [[{}, {}], [{}, {}]], "surface": "{}"}})", from.x, from.y, to.x, to.y,
                     surface);
}

/// A bed through the slope and a splay that rises from it at `degrees`, but begins `gap` (m) above it.
Scene splay(double degrees, double gap) {
  constexpr double dip = 20;
  const Vec2 bed{0, 100}, foot = going(bed, dip, 250), start = going(foot, dip + 90, gap);
  return sample::read(generator_scene(
      fmt::format(R"("joints": [{}, {}])", joint(going(bed, dip, -10), going(bed, dip, 600), "bed"),
                  joint(start, going(start, dip + degrees, 900), "splay")),
      slope));
}

Scene lines(const std::string& points) {
  return sample::read(generator_scene(R"("joints": [)" + points + "]", ten_metres));
}

}  // namespace

TEST_CASE("a joint that ends within 1e-8 of a line cuts at any angle", "[blocks]") {
  for (const double degrees : {90.0, 30.0, 10.0, 5.0, 2.0, 1.0, 0.1}) {
    for (const double gap : {0.0, 5e-7, 9e-7, 3e-6, 4.9e-6}) {
      CAPTURE(degrees, gap);
      const Scene scene = splay(degrees, gap);
      REQUIRE(scene.bodies.size() == 3);
      CHECK(scene.warnings.empty());
      CHECK(area_sum(scene.bodies) == Approx(500.0 * 500).epsilon(1e-12));
    }
  }
  // Farther off it is told.
  for (const double degrees : {90.0, 10.0, 1.0}) {
    CAPTURE(degrees);
    const Scene scene = splay(degrees, 2e-5);
    CHECK(scene.bodies.size() == 2);
    REQUIRE(scene.warnings.size() == 1);
    CHECK_THAT(scene.warnings[0], Contains("1 end of drawn lines") && Contains("is 2e-05 m from it"));
  }
}

TEST_CASE("a joint that is led on to a line keeps its name and gains no corner", "[blocks]") {
  // Below the bed, above bed and splay, and the wedge between them: the splay leaves at the right, at y =
  // 272.
  for (const double gap : {0.0, 4e-6}) {
    CAPTURE(gap);
    std::size_t corners = 0, splays = 0, beds = 0;
    const Scene scene = splay(5, gap);
    for (const SceneBody& body : scene.bodies) {
      corners += body.outer.vertices.size();
      for (const std::uint32_t surface : body.outer.surface_class) {
        if (scene.surfaces[surface].surface == "splay") ++splays;
        if (scene.surfaces[surface].surface == "bed") ++beds;
      }
    }
    CHECK(corners == 4 + 3 + 5);
    CHECK(splays == 2);
    CHECK(beds == 3);
  }
}

TEST_CASE("lines whose ends miss each other by rounding are one", "[blocks]") {
  for (const char* next : {"[5, 5]", "[5.00000005, 5]", "[5, 5.00000005]", "[5.00000001, 5.00000002]"}) {
    CAPTURE(next);
    const Scene scene =
        lines(fmt::format(R"({{"points": [[0, 4], [5, 5]]}}, {{"points": [{}, [10, 6]]}})", next));
    CHECK(scene.bodies.size() == 2);
    CHECK(scene.warnings.empty());
  }
  // The tip of a V just above a line.
  const Scene tip =
      lines(R"({"points": [[0, 5], [10, 5]]}, {"points": [[3, 10], [5, 5.00000005], [7, 10]]})");
  CHECK(tip.bodies.size() == 3);
}

TEST_CASE("of lines in a chain the end alone is loose", "[blocks]") {
  const Scene chain = lines(R"({"points": [[0, 1], [5, 0.5]]}, {"points": [[5, 0.5], [8, 5]]})");
  REQUIRE(chain.warnings.size() == 2);
  CHECK_THAT(chain.warnings[0], Contains("1 end of drawn lines") && Contains("at (8, 5), is 2 m from it"));
  // A line that itself cuts nothing is one to be short of.
  const Scene beside = lines(R"({"points": [[0, 1], [5, 1]]}, {"points": [[3, 4], [3, 1.25]]})");
  CHECK_THAT(beside.warnings[0],
             Contains("3 ends of drawn lines") && Contains("at (3, 1.25), is 0.25 m from it"));
}

TEST_CASE("a line that is drawn twice ends as loose as if it were drawn once", "[blocks]") {
  for (const char* end : {"[5, 0.5]", "[5, 0.500000001]"}) {
    CAPTURE(end);
    const Scene twice =
        lines(fmt::format(R"({{"points": [[0, 1], [5, 0.5]]}}, {{"points": [[0, 1], {}]}})", end));
    CHECK(twice.bodies.size() == 1);
    REQUIRE(twice.warnings.size() == 2);
    CHECK_THAT(twice.warnings[0], Contains("2 ends of drawn lines") && Contains("is 0.5 m from it"));
  }
}
