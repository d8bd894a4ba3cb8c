#include "blocks/generator.hpp"
#include "scene/bad_scene.hpp"
#include "scene/sample.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>

using namespace talus;
using Catch::Matchers::Contains;

namespace {

const std::string grid = R"("joint_sets": [{"dip": 0, "spacing": 0.5}, {"dip": 90, "spacing": 0.25}])";

std::string with(std::string text, const std::string& old_text, const std::string& new_text) {
  return text.replace(text.find(old_text), old_text.size(), new_text);
}

}  // namespace

TEST_CASE("blocks stand behind the written bodies and are named like them", "[blocks]") {
  std::string text = generator_scene(grid + R"(, "velocity": [1, 2], "cover": {"model": "rigid"})");
  text = with(text, "\"time\"", R"("bodies": [{"name": "floor", "polygon": [[0, -1], [1, -1], [1, 0], [0, 0]],
    "material": "rock", "fixed": true}], "loads": [{"body": "b_3", "point": [0.3, 0.1], "force": [1, 0]}],
    "monitors": [{"name": "m", "body": "b_8"}], "origin": [100, 0], "time")");
  const Scene scene = sample::read(text);
  REQUIRE(scene.bodies.size() == 9);
  CHECK(scene.bodies[0].name == "floor");
  CHECK(scene.bodies[scene.monitors[0].body].name == "b_8");
  CHECK(scene.bodies[scene.loads[0].body].name == "b_3");
  CHECK(scene.bodies[5].velocity.y == 2);
  CHECK(std::string(scene.bodies[5].cover.component->component->name) == "rigid");
  CHECK(scene.origin.x == 100);
  CHECK(scene.bodies[8].outer.vertices[0].x == 0.75);  // of the scene, without the origin
}

TEST_CASE("the resolved scene holds plain bodies and reads the same", "[blocks]") {
  const Scene scene = sample::read(generator_scene(grid));
  const auto resolved = nlohmann::json::parse(scene.resolved);
  CHECK_FALSE(resolved.contains("blocks"));
  CHECK(resolved["bodies"].size() == 8);
  CHECK(sample::read(scene.resolved).resolved == scene.resolved);
}

TEST_CASE("overrides reach generators, and stages the blocks", "[blocks]") {
  ReadOptions options;
  options.overrides = {{"/blocks/0/joint_sets/1/spacing", "0.5"}};
  CHECK(sample::read(generator_scene(grid), options).bodies.size() == 4);
  const std::string stage =
      R"("stages": [{"name": "hold", "from": 0.5, "set": {"/bodies/7/fix": ["x"]}}], "time")";
  const Scene scene = sample::read(with(generator_scene(grid), "\"time\"", stage));
  CHECK(scene.stages[0].settings.supports[7].x.has_value());
  CHECK_FALSE(scene.stages[0].settings.supports[6].x.has_value());
}

TEST_CASE("mistakes in a generator are told once, at the generator", "[blocks]") {
  const std::vector<sample::BadPart> parts{
      {"unknown key",
       R"("joint_set": [])",
       "/blocks/0/joint_set",
       "\"joint_set\"",
       {"did you mean \"joint_sets\"?"}},
      {"key of a set",
       R"("joint_sets": [{"dip": 0, "spacing": 1, "spacng": 1}])",
       "/blocks/0/joint_sets/0/spacng",
       "\"spacng\"",
       {"did you mean \"spacing\"?"}},
      {"no spacing", R"("joint_sets": [{"dip": 0}])", "/blocks/0/joint_sets/0", "{", {"\"spacing\"", "m"}},
      {"range",
       R"("joint_sets": [{"dip": 0, "spacing": -1}])",
       "/blocks/0/joint_sets/0/spacing",
       "-1",
       {"greater than 0"}},
      {"bridges without length",
       R"("joint_sets": [{"dip": 0, "spacing": 0.5, "persistence": 0.5}])",
       "/blocks/0/joint_sets/0",
       "{",
       {"\"gap\" must say"}},
      {"length without bridges",
       R"("joint_sets": [{"dip": 0, "spacing": 0.5, "gap": 0.5}])",
       "/blocks/0/joint_sets/0/gap",
       "\"gap\"",
       {"leaves no bridges"}},
      {"seed", R"("voronoi": {"count": 3, "seed": 1.5})", "/blocks/0/voronoi/seed", "1.5", {"whole number"}},
      {"cells two ways", R"("voronoi": {"count": 3, "spacing": 1})", "/blocks/0/voronoi", "{", {"keep one"}},
      {"cells no way", R"("voronoi": {"seed": 3})", "/blocks/0/voronoi", "{", {"\"count\" or \"spacing\""}},
      {"bond",
       R"("bricks": {"width": 1, "height": 1, "bond": "runing"})",
       "/blocks/0/bricks/bond",
       "\"runing\"",
       {"did you mean \"running\"?"}},
      {"line",
       R"("joints": [{"points": [[0, 0]]}])",
       "/blocks/0/joints/0/points",
       "[[0, 0]]",
       {"at least two"}},
      {"shared key", R"("fix": ["z"])", "/blocks/0/fix/0", "\"z\"", {"\"rotation\""}},
      {"cover",
       R"("cover": {"model": "blok"})",
       "/blocks/0/cover/model",
       "\"blok\"",
       {"did you mean \"block\"?"}},
      {"too many",
       R"("joint_sets": [{"dip": 0, "spacing": 1e-4}, {"dip": 90, "spacing": 5e-5}])",
       "/blocks/0",
       "{",
       {"about 2e+08 blocks", "1e+06 at most"}},
      {"too many lines", R"("joint_sets": [{"dip": 0, "spacing": 1e-300}])", "/blocks/0", "{", {"at most"}},
      {"none left", R"("smallest_area": 2)", "/blocks/0", "{", {"no block is left"}},
      {"name of a material, set",
       R"("joint_sets": [{"dip": 0, "spacing": 0.5, "surface": "weak"}, {"dip": 90, "spacing": 1, "surface": "rock"}])",
       "/blocks/0/joint_sets/1/surface",
       "\"surface\"",
       {"\"rock\" is the name of a material", "rename one"}},
      {"name of a material, joint",
       R"("joints": [{"points": [[0, 0.5], [1, 0.5]], "surface": "rock"}])",
       "/blocks/0/joints/0/surface",
       "\"surface\"",
       {"\"rock\" is the name of a material", "rename one"}},
      {"name of a material, side",
       R"("surfaces": {"rock": [0]})",
       "/blocks/0/surfaces/rock",
       "\"rock\"",
       {"\"rock\" is the name of a material", "rename one"}},
      {"path", R"("dxf": 3)", "/blocks/0/dxf", "3", {"path of a drawing"}},
  };
  for (const sample::BadPart& bad : parts) {
    DYNAMIC_SECTION(bad.requirement) {
      sample::check_alone(bad, generator_scene(bad.part));
    }
  }
}

TEST_CASE("mistakes in a domain are told at the domain", "[blocks]") {
  const auto crossed = sample::mistakes(generator_scene(grid, "[[0, 0], [1, 1], [1, 0], [0, 1]]"));
  REQUIRE(crossed.size() == 1);
  CHECK(crossed[0].pointer == "/blocks/0/domain");
  CHECK_THAT(crossed[0].message, Contains("intersects itself"));
  const auto few = sample::mistakes(generator_scene(grid, "[[0, 0], [1, 1]]"));
  REQUIRE(few.size() == 1);
  CHECK_THAT(few[0].message, Contains("at least 3"));
}

TEST_CASE("what follows from a generator that failed is not told", "[blocks]") {
  std::string text = generator_scene(R"("joint_sets": [{"dip": 0}])");
  text = with(text, "\"time\"", R"("monitors": [{"name": "m", "body": "b_4"}], "time")");
  CHECK(sample::mistakes(text).size() == 1);
  text = with(text, "\"material\": \"rock\"", "\"material\": \"rck\"");
  const auto found = sample::mistakes(text);
  REQUIRE(found.size() == 2);
  CHECK(found[0].pointer == "/blocks/0/material");
}

TEST_CASE("names of blocks and of generators must not clash, nor blocks and bodies overlap", "[blocks]") {
  std::string text = generator_scene(grid);
  text = with(text, "\"time\"", R"("bodies": [{"name": "b_2", "polygon": [[0, -1], [1, -1], [1, 0], [0, 0]],
    "material": "rock"}], "time")");
  const auto named = sample::mistakes(text);
  REQUIRE(named.size() == 1);
  CHECK(named[0].pointer == "/blocks/0/name");
  CHECK_THAT(named[0].message, Contains("\"b_2\" is the name of /bodies/0 already"));
  text = with(with(text, "b_2", "low"), "[1, 0], [0, 0]]", "[1, 0], [0, 0.5]]");
  const auto over = sample::mistakes(text);
  REQUIRE_FALSE(over.empty());
  CHECK(over[0].pointer == "/blocks/0/domain");
  CHECK_THAT(over[0].message, Contains("\"low\" and \"b_1\" overlap"));
  std::string twice = generator_scene("");
  twice = with(twice, "\"blocks\": [",
               R"("blocks": [{"name": "b", "domain": [[5, 5], [6, 5], [6, 6]], "material": "rock"}, )");
  const auto same = sample::mistakes(twice);
  REQUIRE(same.size() == 1);
  CHECK(same[0].pointer == "/blocks/1/name");
  CHECK_THAT(same[0].message, Contains("the name of /blocks/0 already"));
}

TEST_CASE("blocks that are no list of generators are refused in words", "[blocks]") {
  const auto found =
      sample::mistakes(with(generator_scene(""), "\"blocks\": [", "\"blocks\": 3, \"title\": ["));
  const auto at_blocks =
      std::find_if(found.begin(), found.end(), [](const Mistake& one) { return one.pointer == "/blocks"; });
  REQUIRE(at_blocks != found.end());
  CHECK_THAT(at_blocks->message, Contains("3 is not allowed here: expected a list of generators"));
}

TEST_CASE("joints that cut nothing are told of", "[blocks]") {
  const Scene whole = sample::read(generator_scene(R"("joints": [{"points": [[-1, 0.5], [0.9, 0.5]]}])"));
  CHECK(whole.bodies.size() == 1);
  REQUIRE(whole.warnings.size() == 2);
  CHECK_THAT(whole.warnings[0],
             Contains("1 end of drawn lines within a block") && Contains("at (0.9, 0.5), is 0.1 m from it"));
  CHECK_THAT(whole.warnings[1], Contains("'b' stays one block: nothing cuts its domain"));
  CHECK(sample::read(generator_scene(grid)).warnings.empty());
  // Of the second line the upper end is just short of the first; what meets a line or the boundary does not
  // miss it.
  const Scene three = sample::read(generator_scene(
      R"("joints": [{"points": [[0, 0.5], [1, 0.5]]}, {"points": [[0.5, 0], [0.5, 0.499]]},
                    {"points": [[0.25, 0.5], [0.25, 1]]}])"));
  CHECK(three.bodies.size() == 3);
  REQUIRE(three.warnings.size() == 1);
  CHECK_THAT(three.warnings[0], Contains("at (0.5, 0.499), is 0.001 m from it"));
  // Short by the rounding of a drawing with few decimals, and by less than ends are lengthened by.
  for (const char* end : {"0.49999", "0.4999999", "0.49999998", "0.499999999"}) {
    CAPTURE(end);
    const std::string drawn = fmt::format(
        R"("joints": [{{"points": [[-1, 0.5], [2, 0.5]]}}, {{"points": [[0.5, -1], [0.5, {}]]}}])", end);
    const Scene scene = sample::read(generator_scene(drawn));
    const bool cuts = std::string(end) == "0.499999999";
    CHECK(scene.bodies.size() == (cuts ? 3 : 2));
    CHECK(scene.warnings.size() == (cuts ? 0 : 1));
  }
  // Far from zero, too, a place is told in figures that find it.
  const Scene far = sample::read(generator_scene(
      R"("joints": [{"points": [[499990, 5000000.5], [500010, 5000000.5]]},
                    {"points": [[500000.25, 4999990], [500000.25, 5000000.499]]}])",
      "[[500000, 5000000], [500001, 5000000], [500001, 5000001], [500000, 5000001]]"));
  REQUIRE(far.warnings.size() == 1);
  CHECK_THAT(far.warnings[0], Contains("at (500000.25, 5000000.499), is 0.001 m from it"));
  // Beside a mistake, too, which may come from it.
  try {
    sample::read(
        with(generator_scene(R"("joints": [{"points": [[-1, 0.5], [0.9, 0.5]]}])"), "\"time\"", "\"thyme\""));
    FAIL("no mistake");
  } catch (const SceneError& error) {
    CHECK(error.warnings.size() == 2);
  }
}

TEST_CASE("blocks that joined until one was left are told of", "[blocks]") {
  const Scene one =
      sample::read(generator_scene(R"("joint_sets": [{"dip": 0, "spacing": 0.3}], "smallest_area": 0.6)"));
  CHECK(one.bodies.size() == 1);
  REQUIRE(one.warnings.size() == 1);
  CHECK_THAT(
      one.warnings[0],
      Contains("'b' stays one block: lines cut its domain into 4, of which those below the smallest area"));
}
