#include "output/scratch.hpp"
#include "scene/bad_scene.hpp"

#include <nlohmann/json.hpp>

#include <catch2/catch.hpp>

using namespace talus;
using nlohmann::json;
using talus::sample::BadPart;
using talus::sample::good_with;

namespace {

std::string stages(const std::string& list) {
  return good_with("\"stages\": [" + list + "]");
}

std::string stage(const std::string& set, const std::string& from = "1") {
  return R"({"name": "s", "from": )" + from + R"(, "set": {)" + set + "}}";
}

const BadPart bad_stages[] = {
    {"stages that are no object", "3", "/stages/0", "3", {"3 is not allowed here", "object"}},
    {"a stage without a name",
     R"({"from": 1, "set": {}})",
     "/stages/0",
     "{\"from\"",
     {"required key \"name\""}},
    {"a stage without a time",
     R"({"name": "s", "set": {}})",
     "/stages/0",
     "{\"name\"",
     {"required key \"from\"", "[s]"}},
    {"a stage without values",
     R"({"name": "s", "from": 1})",
     "/stages/0",
     "{\"name\"",
     {"required key \"set\"", "/gravity"}},
    {"values that are no object",
     R"({"name": "s", "from": 1, "set": []})",
     "/stages/0/set",
     "[]",
     {"[] is not allowed here", "pointers and values"}},
    {"an unknown key",
     R"({"name": "s", "from": 1, "set": {}, "until": 2})",
     "/stages/0/until",
     "\"until\"",
     {"unknown key", "name, from, set"}},
    {"a stage at the start",
     R"({"name": "s", "from": 0, "set": {}})",
     "/stages/0/from",
     "0",
     {"greater than 0"}},
    {"a stage at the end",
     R"({"name": "s", "from": 5, "set": {}})",
     "/stages/0/from",
     "5",
     {"5 s is not before the end of the run at 5 s"}},
    {"stages out of order",
     R"({"name": "s", "from": 2, "set": {}}, {"name": "t", "from": 2, "set": {}})",
     "/stages/1/from",
     "2, \"set\": {}}]",
     {"2 s is not after 2 s", "order of their times"}},
    {"what is no pointer",
     R"({"name": "s", "from": 1, "set": {"gravity": [0, 0]}})",
     "/stages/0/set/gravity",
     "\"gravity\"",
     {"no JSON pointer", "/gravity, /damping"}},
    {"what does not change during a run",
     R"({"name": "s", "from": 1, "set": {"/time/end": 7}})",
     "/stages/0/set/~1time~1end",
     "\"/time/end\"",
     {"does not change during a run",
      "/gravity, /damping, /base_acceleration, /interfaces, /loads, /surface_loads, /prescribed, /absorbing, "
      "/bodies/*/fix, /bodies/*/drive"}},
    {"a part of a body that does not change during a run",
     R"({"name": "s", "from": 1, "set": {"/bodies/1/fixed": true}})",
     "/stages/0/set/~1bodies~11~1fixed",
     "\"/bodies/1/fixed\"",
     {"does not change during a run"}},
    {"all bodies at once",
     R"({"name": "s", "from": 1, "set": {"/bodies": []}})",
     "/stages/0/set/~1bodies",
     "\"/bodies\"",
     {"does not change during a run"}},
    {"a body that does not exist",
     R"({"name": "s", "from": 1, "set": {"/bodies/2/fix": []}})",
     "/stages/0/set/~1bodies~12~1fix",
     "\"/bodies/2/fix\"",
     {"/bodies/2: the list has no entry \"2\"", "from 0 to 1"}},
    {"a load that does not exist",
     R"({"name": "s", "from": 1, "set": {"/loads/1/force": [0, 0]}})",
     "/stages/0/set/~1loads~11~1force",
     "\"/loads/1/force\"",
     {"/loads/1: the list has no entry \"1\""}},
    {"a wrong value is told at the entry",
     R"({"name": "s", "from": 1, "set": {"/damping": "much"}})",
     "/stages/0/set/~1damping",
     "\"much\"",
     {"\"much\" is not allowed here", "\"adaptive\""}},
    {"a mistake within a value is told within the entry",
     R"({"name": "s", "from": 1, "set": {"/loads": [{"body": "blok", "point": [2, 2], "force": [1, 0]}]}})",
     "/stages/0/set/~1loads/0/body",
     "\"blok\"",
     {"no body \"blok\"", "did you mean \"block\""}},
    {"a support that contradicts another",
     R"({"name": "s", "from": 1, "set": {"/bodies/1/fix": ["x"], "/bodies/1/drive": {"x": 1}}})",
     "/stages/0/set/~1bodies~11~1drive/x",
     "1}",
     {"fixed and driven"}},
    {"a support of a fixed body",
     R"({"name": "s", "from": 1, "set": {"/bodies/0/fix": ["x"]}})",
     "/stages/0/set/~1bodies~10~1fix",
     "\"/bodies/0/fix\"",
     {"the body is \"fixed\""}},
    {"an interface value out of range",
     R"({"name": "s", "from": 1, "set": {"/interfaces/0/friction_angle": 90}})",
     "/stages/0/set/~1interfaces~10~1friction_angle",
     "90",
     {"90 is out of range", "[deg]"}},
    {"rows that match other surfaces",
     R"({"name": "s", "from": 1, "set": {"/interfaces": [
        {"between": ["*", "*"], "normal_stiffness": 1, "friction_angle": 1, "normal_damping": 0},
        {"between": ["rock", "*"], "normal_stiffness": 1, "friction_angle": 1, "normal_damping": 0}]}})",
     "/stages/0/set/~1interfaces",
     "[",
     {"match other surfaces", "\"between\""}},
    {"a mistake is told once, where it is made",
     R"({"name": "s", "from": 1, "set": {"/gravity": [0]}}, {"name": "t", "from": 2, "set": {"/damping": 1}})",
     "/stages/0/set/~1gravity",
     "[0]",
     {"[x, y]"}},
};

}  // namespace

TEST_CASE("every mistake in a stage is told with its place and what would be right", "[scene]") {
  for (const BadPart& bad : bad_stages) {
    DYNAMIC_SECTION(bad.requirement) {
      sample::check_alone(bad, stages(bad.part));
    }
  }
}

TEST_CASE("stages that are no list are named", "[scene]") {
  sample::check_alone({"", "", "/stages", "{}", {"a list of stages"}}, good_with("\"stages\": {}"));
}

TEST_CASE("a scene without stages has none", "[scene]") {
  CHECK(sample::read(sample::good).stages.empty());
  CHECK(json::parse(sample::read(sample::good).resolved)["stages"] == json::array());
}

TEST_CASE("a stage changes what it sets and keeps the rest, and the next builds on it", "[scene]") {
  const Scene scene = sample::read(stages(
      R"({"name": "pull", "from": 1, "set": {"/gravity/1": -5, "/loads/0/force": [[1, {"time": [[1, 0], [2, 4]]}], 0],
          "/bodies/1/fix": ["y"], "/interfaces/0/friction_angle": 10, "/damping": "adaptive",
          "/absorbing": [{"body": "block", "surface": "side"}]}},
         {"name": "let go", "from": 2.5, "set": {"/bodies/1/fix": [], "/loads": [], "/bodies/1/drive/x": 3,
          "/base_acceleration": [1, 0], "/surface_loads": [{"body": "block", "surface": "base", "pressure": 2}],
          "/prescribed": [{"body": "block", "surface": "base", "stiffness": 1, "velocity": [1, null]}]}})"));
  CHECK(scene.gravity.y == -10);
  CHECK_FALSE(scene.bodies[1].support.y.has_value());
  REQUIRE(scene.stages.size() == 2);
  CHECK(scene.stages[0].name == "pull");
  CHECK(scene.stages[0].from == 1);
  const StageSettings &first = scene.stages[0].settings, &second = scene.stages[1].settings;
  CHECK(first.gravity.y == -5);
  CHECK(first.gravity.x == 0);
  REQUIRE(first.loads.size() == 1);
  CHECK(first.loads[0].force[0](1.5, {}) == 3);
  CHECK(first.loads[0].point.x == 2);
  CHECK(first.supports.size() == 2);
  CHECK(first.supports[1].y == 0.0);
  CHECK(first.interface_values[0][1] == Approx(scene.interface_values[0][1] / 2));
  CHECK(first.interface_values[0][2] == scene.interface_values[0][2]);
  CHECK(first.damping.kind == Damping::Kind::adaptive);
  CHECK(first.absorbing.size() == 1);
  CHECK(first.surface_loads.empty());

  CHECK(scene.stages[1].from == 2.5);
  CHECK(second.gravity.y == -5);
  CHECK(second.interface_values == first.interface_values);
  CHECK(second.damping.kind == Damping::Kind::adaptive);
  CHECK(second.loads.empty());
  CHECK_FALSE(second.supports[1].y.has_value());
  CHECK(second.supports[1].x == 3.0);
  CHECK(second.base_acceleration[0](9, {}) == 1);
  CHECK(second.surface_loads[0].pressure(9, {}) == 2);
  CHECK((*second.prescribed[0].velocity[0])(9, {}) == 1);
  CHECK(second.absorbing.size() == 1);
}

TEST_CASE("velocities at the start contradict no support that comes later", "[scene]") {
  std::string text = stages(stage("\"/bodies/1/fix\": [\"x\"]"));
  text.replace(text.find("\"material\": \"rock\""), 18, "\"material\": \"rock\", \"velocity\": [1, 0]");
  CHECK(sample::read(text).stages[0].settings.supports[1].x == 0.0);
}

TEST_CASE("interfaces of a stage may be written anew with the same rows", "[scene]") {
  const Scene scene = sample::read(stages(stage(
      R"("/interfaces": [{"between": ["*", "*"], "normal_stiffness": 7, "friction_angle": 1, "normal_damping": 0}])")));
  CHECK(scene.stages[0].settings.interface_values[0][2] == 7);
  CHECK(scene.interface_values[0][2] == 1e10);
}

TEST_CASE("interfaces of a stage must match the same surfaces, even where the number of rows is kept",
          "[scene]") {
  std::string text = stages(stage("\"/interfaces/1/between\": [\"*\", \"rock\"]"));
  const std::string row = "\"normal_stiffness\": 1e10, \"friction_angle\": 20, \"normal_damping\": 0.3}";
  text.insert(text.find(row) + row.size(), ",\n{\"between\": [\"*\", \"top\"], " + row);
  const auto found = sample::mistakes(text);
  REQUIRE(found.size() == 1);
  CHECK(found[0].pointer == "/stages/0/set/~1interfaces~11~1between");
  CHECK_THAT(found[0].message, Catch::Contains("match other surfaces"));
}

TEST_CASE("mistakes of the scene and of its stages are told at once, each once", "[scene]") {
  std::string text = stages(stage("\"/gravity\": 3, \"/time/end\": 1") + ", " +
                            stage("\"/damping\": -1, \"/loads\": 7", "2"));
  text.replace(text.find("\"end\": 5"), 8, "\"end\": 5, \"step\": 1");
  text.replace(text.find("1e10}"), 5, "0}");
  const auto found = sample::mistakes(text);
  REQUIRE(found.size() == 6);
  CHECK(found[0].pointer == "/materials/rock/young_modulus");
  CHECK(found[1].pointer == "/stages/0/set/~1gravity");
  CHECK(found[2].pointer == "/stages/0/set/~1time~1end");
  CHECK(found[3].pointer == "/stages/1/set/~1damping");
  CHECK(found[4].pointer == "/stages/1/set/~1loads");
  CHECK(found[5].pointer == "/time/step");
}

TEST_CASE("what a stage makes wrong around its values is told at them with the pointer", "[scene]") {
  const auto found = sample::mistakes(stages(stage("\"/interfaces/0/between\": [\"rock\", \"top\"]")));
  REQUIRE(found.size() == 3);  // steel against base, side and the other edges of the block
  for (const Mistake& mistake : found) {
    CHECK(mistake.pointer == "/stages/0/set/~1interfaces~10~1between");
    CHECK_THAT(mistake.message, Catch::StartsWith("/interfaces: no row covers \"steel\" against"));
  }
}

TEST_CASE("a stage warns of what the law does not read", "[scene]") {
  const ReadOptions smooth{{{"/contact/model", "smooth"}, {"/interfaces/0/friction_angle", "0"}}, false};
  const Scene scene = sample::read(stages(stage("\"/interfaces/0/friction_angle\": 3")), smooth);
  CHECK(scene.warnings == std::vector<std::string>{"/interfaces: smooth reads no friction_angle"});
}

TEST_CASE("a --set reaches into stages and is told when it is wrong", "[scene]") {
  const std::string text = stages(stage("\"/gravity\": [0, -5]"));
  const Scene scene = sample::read(text, {{{"/stages/0/set/~1gravity", "[0, -3]"}}, false});
  CHECK(scene.stages[0].settings.gravity.y == -3);
  CHECK(sample::read(text, {{{"/gravity", "[7, 0]"}, {"/stages/0/set/~1damping", "2"}}, false})
            .stages[0]
            .settings.damping.constant == 2);
  const auto found = sample::mistakes(text, {{{"/stages/0/set/~1gravity", "[0, \"g\"]"}}, false});
  REQUIRE(found.size() == 1);
  CHECK(found[0].file == "--set /stages/0/set/~1gravity=[0, \"g\"]");
  CHECK(found[0].pointer == "/stages/0/set/~1gravity/1");
}

TEST_CASE("the resolved scene keeps its stages, and reads again as the same", "[scene]") {
  const Scratch scratch;
  scratch.write("pull.csv", "0,0\n1,2\n");
  Registry registry = sample::registry();
  const std::string text = stages(
      stage(R"("/loads/0/force": [{"time": "pull.csv"}, 0], "/bodies/1/fix": ["y"])") + ", " +
      stage(R"("/bodies/1/fix": [], "/prescribed": [{"body": "block", "surface": "base", "stiffness": 1,
                       "velocity": [1, null]}])",
            "2"));
  const Scene first = read_scene_text(text, (scratch / "scene.json").string(), registry);
  const json resolved = json::parse(first.resolved)["stages"];
  REQUIRE(resolved.size() == 2);
  CHECK(resolved[0]["set"]["/loads/0/force"][0]["time"] == (scratch / "pull.csv").string());
  CHECK(resolved[0]["set"]["/bodies/1/fix"] == json({"y"}));
  CHECK(resolved[1]["set"]["/prescribed"][0]["ramp"] == 0);
  const Scene second = read_scene_text(first.resolved, "/elsewhere/scene.json", registry);
  CHECK(second.resolved == first.resolved);
  CHECK(second.stages[0].settings.loads[0].force[0](0.5, {}) == 1);
}
