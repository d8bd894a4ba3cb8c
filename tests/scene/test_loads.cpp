#include "output/scratch.hpp"
#include "scene/bad_scene.hpp"

#include <nlohmann/json.hpp>

#include <fmt/format.h>
#include <catch2/catch.hpp>

using namespace talus;
using nlohmann::json;
using talus::sample::BadPart;
using talus::sample::good_with;

namespace {

const std::string time_table = R"({"scale": 2, "time": [[0, 0], [2, 6]]})";

std::string load(const std::string& force) {
  return sample::good_but("\"force\": [1, 0]", "\"force\": " + force);
}

VectorFunction force(const std::string& written) {
  return sample::read(load(written)).loads[0].force;
}

const BadPart bad_forces[] = {
    {"a force of one number", "3", "/loads/0/force", "3}", {"3 is not allowed here", "[x, y]", "[N/m]"}},
    {"a word for a component",
     R"(["much", 0])",
     "/loads/0/force/0",
     "\"much\"",
     {"\"much\" is not allowed here", "a number [N/m]", "\"time\"", "to be summed"}},
    {"null for a component", "[null, 0]", "/loads/0/force/0", "null", {"null is not allowed here"}},
    {"a sum of nothing", "[[], 0]", "/loads/0/force/0", "[]", {"[] sums up nothing"}},
    {"a list in a sum", "[[[1]], 0]", "/loads/0/force/0/0", "[1]", {"[1] is not allowed here"}},
    {"a product of nothing", "[{}, 0]", "/loads/0/force/0", "{}", {"{} says nothing", "\"time\""}},
    {"an unknown key",
     R"([{"tme": [[0, 0], [1, 1]]}, 0])",
     "/loads/0/force/0/tme",
     "\"tme\"",
     {"unknown key", "did you mean \"time\"", "scale, time, x, y"}},
    {"a scale that is no number", R"([{"scale": "2"}, 0])", "/loads/0/force/0/scale", "\"2\"", {"[N/m]"}},
    {"a time_table that is none",
     R"([{"time": 3}, 0])",
     "/loads/0/force/0/time",
     "3",
     {"3 is not allowed here", "[[at, value], ...]", "\"file.csv\""}},
    {"a time_table of one point",
     R"([{"time": [[0, 1]]}, 0])",
     "/loads/0/force/0/time",
     "[[0, 1]]",
     {"two points"}},
    {"a point of three numbers",
     R"([{"x": [[0, 1], [1, 2, 3]]}, 0])",
     "/loads/0/force/0/x/1",
     "[1, 2, 3]",
     {"[1,2,3] is no point of a table", "[at, value]"}},
    {"a point with a word",
     R"([{"y": [[0, 1], [1, "2"]]}, 0])",
     "/loads/0/force/0/y/1",
     "[1, \"2\"]",
     {"two numbers"}},
    {"a time_table that does not rise",
     R"([0, [5, {"time": [[0, 1], [2, 2], [2, 3]]}]])",
     "/loads/0/force/1/1/time/2/0",
     "2, 3]",
     {"2 does not come after 2", "rise strictly"}},
    {"a file that is not there",
     R"([{"time": "none.csv"}, 0])",
     "/loads/0/force/0/time",
     "\"none.csv\"",
     {"there is no file none.csv"}},
    {"a file without a name", R"([{"time": ""}, 0])", "/loads/0/force/0/time", "\"\"", {"\"file.csv\""}},
};

const BadPart bad_loads[] = {
    {"a surface load without a load",
     R"("surface_loads": [{"body": "block", "surface": "base"}])",
     "/surface_loads/0",
     "{\"body\"",
     {"nothing acts", "\"traction\": [tx, ty] [Pa]", "\"pressure\" [Pa]"}},
    {"a surface load on a fixed body",
     R"("surface_loads": [{"body": "ramp", "surface": "top", "pressure": 1}])",
     "/surface_loads/0/body",
     "\"ramp\"",
     {"\"ramp\" is fixed"}},
    {"a surface load on a surface that the body has not",
     R"("surface_loads": [{"body": "block", "surface": "top", "pressure": 1}])",
     "/surface_loads/0/surface",
     "\"top\"",
     {"\"block\" has no surface \"top\"", "base, side"}},
    {"a surface load without a surface",
     R"("surface_loads": [{"body": "block", "pressure": 1}])",
     "/surface_loads/0",
     "{\"body\"",
     {"required key \"surface\""}},
    {"a traction that is no pair",
     R"("surface_loads": [{"body": "block", "surface": "base", "traction": 3}])",
     "/surface_loads/0/traction",
     "3",
     {"[x, y]", "[Pa]"}},
    {"a pressure that is a pair of words",
     R"("surface_loads": [{"body": "block", "surface": "base", "pressure": ["a", 1]}])",
     "/surface_loads/0/pressure/0",
     "\"a\"",
     {"[Pa]"}},
    {"surface loads that are no list", R"("surface_loads": {})", "/surface_loads", "{}", {"a list of loads"}},
    {"an unknown key of a surface load",
     R"("surface_loads": [{"body": "block", "surface": "base", "presure": 1, "pressure": 1}])",
     "/surface_loads/0/presure",
     "\"presure\"",
     {"did you mean \"pressure\""}},
    {"an absorbing surface of a fixed body",
     R"("absorbing": [{"body": "ramp", "surface": "top"}])",
     "/absorbing/0/body",
     "\"ramp\"",
     {"\"ramp\" is fixed"}},
    {"an absorbing surface that the body has not",
     R"("absorbing": [{"body": "block", "surface": "bse"}])",
     "/absorbing/0/surface",
     "\"bse\"",
     {"did you mean \"base\""}},
    {"a surface that absorbs twice",
     R"("absorbing": [{"body": "block", "surface": "base"}, {"body": "block", "surface": "base"}])",
     "/absorbing/1/surface",
     "\"base\"",
     {"listed already"}},
    {"an unknown key of an absorbing surface",
     R"("absorbing": [{"body": "block", "surface": "base", "stiffness": 1}])",
     "/absorbing/0/stiffness",
     "\"stiffness\"",
     {"unknown key", "body, surface"}},
    {"an acceleration of the ground that depends on the place",
     R"("base_acceleration": [{"time": [[0, 0], [1, 1]], "x": [[0, 0], [1, 1]]}, 0])",
     "/base_acceleration/0/x",
     "\"x\"",
     {"\"x\" is not allowed here", "\"time\" alone"}},
    {"an acceleration of the ground that is no pair",
     R"("base_acceleration": 9.81)",
     "/base_acceleration",
     "9.81",
     {"[x, y]", "[m/s2]"}},
    {"a motion that prescribes nothing",
     R"("prescribed": [{"body": "block", "surface": "base", "stiffness": 1, "velocity": [null, null]}])",
     "/prescribed/0",
     "{\"body\"",
     {"nothing is prescribed"}},
    {"a prescribed motion that is a word",
     R"("prescribed": [{"body": "block", "surface": "base", "stiffness": 1, "velocity": ["fast", null]}])",
     "/prescribed/0/velocity/0",
     "\"fast\"",
     {"\"fast\" is not allowed here", "[m/s]"}},
    {"a prescribed motion that is no pair",
     R"("prescribed": [{"body": "block", "surface": "base", "stiffness": 1, "displacement": 1}])",
     "/prescribed/0/displacement",
     "1",
     {"[x, y]", "or null"}},
};

}  // namespace

TEST_CASE("a component of a load is a number, a product of tables or a sum", "[scene]") {
  CHECK(force("[3, -4]")[0](9, {}) == 3);
  CHECK(force("[3, -4]")[1](9, {}) == -4);
  CHECK(force("[0, 1]")[0].zero());
  CHECK(force("[" + time_table + ", 1]")[0](1, {}) == 6);
  CHECK(force("[1, [5, " + time_table + "]]")[1](1, {}) == 11);
  CHECK(force(R"([{"x": [[0, 1], [2, 3]], "y": [[0, 0], [1, 2]]}, 0])")[0](0, {1, 0.5}) == 2);
  CHECK(force(R"([{"scale": 5}, {"scale": 0, "time": [[0, 1], [1, 2]]}])")[0](1, {}) == 5);
  CHECK(force(R"([{"scale": 5}, {"scale": 0, "time": [[0, 1], [1, 2]]}])")[1].zero());
}

TEST_CASE("every mistake in a function is told with its place and what would be right", "[scene]") {
  for (const BadPart& bad : bad_forces) {
    DYNAMIC_SECTION(bad.requirement) {
      sample::check_alone(bad, load(bad.part));
    }
  }
}

TEST_CASE("every mistake in loads on surfaces and in motions is told with its place", "[scene]") {
  for (const BadPart& bad : bad_loads) {
    DYNAMIC_SECTION(bad.requirement) {
      sample::check_alone(bad, good_with(bad.part));
    }
  }
}

TEST_CASE("all mistakes of a function are told at once", "[scene]") {
  const auto found = sample::mistakes(load(R"([[{"time": [[0, 1], [0, "a"]], "z": 1}, "b"], {"x": 7}])"));
  REQUIRE(found.size() == 4);
  CHECK(found[0].pointer == "/loads/0/force/0/0/time/1");
  CHECK(found[1].pointer == "/loads/0/force/0/0/z");
  CHECK(found[2].pointer == "/loads/0/force/0/1");
  CHECK(found[3].pointer == "/loads/0/force/1/x");
}

TEST_CASE("surface loads find their class and keep traction and pressure apart", "[scene]") {
  const Scene scene = sample::read(good_with(R"("surface_loads": [
      {"body": "block", "surface": "side", "pressure": )" +
                                             time_table + R"(},
      {"body": "block", "surface": "base", "traction": [0, 7], "pressure": 1}])"));
  REQUIRE(scene.surface_loads.size() == 2);
  const SurfaceLoad &side = scene.surface_loads[0], &base = scene.surface_loads[1];
  CHECK(side.body == 1);
  CHECK(scene.surfaces[side.surface_class].surface == "side");
  CHECK(side.traction[0].zero());
  CHECK(side.traction[1].zero());
  CHECK(side.pressure(1, {}) == 6);
  CHECK(scene.surfaces[base.surface_class].surface == "base");
  CHECK(base.traction[1](1, {}) == 7);
  CHECK(base.pressure(1, {}) == 1);
}

TEST_CASE("a load on a surface whose tables have other places is warned of", "[scene]") {
  const auto warnings = [](const char* load) {
    return sample::read(good_with(fmt::format(R"("surface_loads": [{{"body": "block", {}}}])", load)))
        .warnings;
  };
  const auto idle = warnings(R"("surface": "side", "pressure": {"scale": 3, "y": [[-30, 1], [-10, 0]]})");
  REQUIRE(idle.size() == 1);
  CHECK(idle[0] ==
        "/surface_loads/0/pressure: the tables over place are 0 all along that surface of 'block', which "
        "reaches from (1, 1) to (2, 2) m");
  CHECK(warnings(R"("surface": "base", "traction": [0, {"scale": 3, "x": [[-30, 1], [1, 0]]}])").size() == 1);
  CHECK(warnings(R"("surface": "base", "traction": [{"x": [[-30, 1], [1, 0]]}, {"x": [[3, 0], [4, 1]]}])")
            .size() == 1);
  for (const char* acts : {R"("surface": "side", "pressure": {"scale": 3, "y": [[-30, 1], [1.5, 0]]})",
                           R"("surface": "base", "pressure": {"x": [[1.2, 0], [1.5, 1], [1.8, 0]]})",
                           R"("surface": "base", "traction": [0, 3])",
                           R"("surface": "base", "pressure": {"scale": 3, "time": [[7, 0], [8, 1]]})"})
    CHECK(warnings(acts).empty());
}

TEST_CASE("loads on surfaces of a scene without materials are read on", "[scene]") {
  std::string text = good_with(
      R"("surface_loads": [{"body": "block", "surface": "side", "pressure": {"scale": 3, "y": [[-30, 1], [-10, 0]]}}])");
  const std::size_t begin = text.find("{\n    \"rock\""), end = text.find("\"contact\"");
  text.replace(begin, end - begin, "[], ");
  const auto found = sample::mistakes(text);
  REQUIRE(!found.empty());
  CHECK(found[0].pointer == "/materials");
}

TEST_CASE("absorbing surfaces find their class", "[scene]") {
  const Scene scene = sample::read(good_with(R"("absorbing": [{"body": "block", "surface": "base"}])"));
  REQUIRE(scene.absorbing.size() == 1);
  CHECK(scene.absorbing[0].body == 1);
  CHECK(scene.surfaces[scene.absorbing[0].surface_class].surface == "base");
}

TEST_CASE("absorbing surfaces of rigid bodies are named, all of them", "[scene]") {
  ReadOptions options;
  options.overrides = {{"/bodies/1/cover", R"({"model": "rigid"})"}};
  const std::vector<Mistake> found =
      sample::mistakes(good_with(R"("absorbing": [{"body": "block", "surface": "base"},
                                                   {"body": "block", "surface": "side"}])"),
                       options);
  REQUIRE(found.size() == 2);
  CHECK(found[0].pointer == "/absorbing/0/body");
  CHECK(found[1].pointer == "/absorbing/1/body");
  CHECK(found[1].line == found[0].line + 1);
  CHECK_THAT(found[0].message, Catch::Contains("\"block\" is rigid") && Catch::Contains("wave speeds"));
}

TEST_CASE("prescribed motions depend on time and place, and an axis may be held at zero or free", "[scene]") {
  const Scene scene =
      sample::read(good_with(R"("prescribed": [{"body": "block", "surface": "base", "stiffness": 1,
      "displacement": [0, null], "velocity": [{"time": [[0, 0], [1, 2]], "x": [[0, 0], [2, 4]]}, null]}])"));
  const PrescribedSurface& prescribed = scene.prescribed[0];
  REQUIRE(prescribed.displacement[0].has_value());
  CHECK(prescribed.displacement[0]->zero());
  CHECK_FALSE(prescribed.displacement[1].has_value());
  CHECK((*prescribed.velocity[0])(0.5, {1, 9}) == 2);
  CHECK(prescribed.velocity[0]->integral(2, {1, 9}) == Approx((1 + 2) * 2));
  CHECK_FALSE(prescribed.velocity[1].has_value());
}

TEST_CASE("the ground accelerates by functions of time", "[scene]") {
  const Scene scene = sample::read(good_with("\"base_acceleration\": [" + time_table + ", -1]"));
  CHECK(scene.base_acceleration[0](1, {}) == 6);
  CHECK(scene.base_acceleration[1](1, {}) == -1);
}

TEST_CASE("tables come from files beside the scene, and the resolved scene finds them from anywhere",
          "[scene]") {
  const Scratch scratch;
  scratch.write("quake.csv", "t, ax, ay\n0, 0, 1\n2, 6, 1\n");
  scratch.write("two:columns.csv", "0, 0\n1, 4\n");
  scratch.write("run:1.csv", "t, a:b\n0, 0\n1, 4\n");
  Registry registry = sample::registry();
  const std::string text = load(R"([{"time": "quake.csv:ax"}, {"scale": 3, "time": "two:columns.csv"}])");
  CHECK(
      read_scene_text(load(R"([{"time": "run:1.csv:a:b"}, 0])"), (scratch / "scene.json").string(), registry)
          .loads[0]
          .force[0](1, {}) == 4);
  const Scene scene = read_scene_text(text, (scratch / "scene.json").string(), registry);
  CHECK(scene.loads[0].force[0](1, {}) == 3);
  CHECK(scene.loads[0].force[1](0.5, {}) == 6);
  const json resolved = json::parse(scene.resolved)["loads"][0]["force"];
  CHECK(resolved[0]["time"] == (scratch / "quake.csv").string() + ":ax");
  CHECK(resolved[0]["scale"] == 1);
  const Scene again = read_scene_text(scene.resolved, "/elsewhere/scene.json", registry);
  CHECK(again.loads[0].force[0](1, {}) == 3);
  CHECK(again.resolved == scene.resolved);
}

TEST_CASE("a mistake in a file of a time_table is told at the pointer with the line of the file", "[scene]") {
  const Scratch scratch;
  const std::string file = scratch.write("quake.csv", "t,ax\n0,0\n1,x\n").string();
  Registry registry = sample::registry();
  const std::string text = load(R"([{"time": "quake.csv"}, 0])"), name = (scratch / "scene.json").string();
  CHECK_THROWS_WITH(read_scene_text(text, name, registry),
                    name + ":16:67: /loads/0/force/0/time: " + file + ":3: \"x\" is no finite number");
}

TEST_CASE("the tables of a scene hold no more points than it takes to fill the memory", "[scene][slow]") {
  const Scratch scratch;
  std::string rows;
  for (int i = 0; i < 1000000; ++i) rows += std::to_string(i) + ",1\n";
  scratch.write("long.csv", rows);
  Registry registry = sample::registry();
  std::string terms;
  for (int i = 0; i < 11; ++i) terms += std::string(i == 0 ? "" : ", ") + R"({"time": "long.csv"})";
  CHECK_THROWS_WITH(
      read_scene_text(load("[[" + terms + "], 0]"), (scratch / "scene.json").string(), registry),
      Catch::Contains("/loads/0/force/0/10/time: the tables of the scene hold more than 10000000 points"));
}
