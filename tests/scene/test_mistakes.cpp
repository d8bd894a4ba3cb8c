#include "scene/bad_scene.hpp"
#include "scene/mistakes.hpp"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace talus;
using talus::sample::BadScene;
using talus::sample::check;

namespace {

const BadScene mistaken_scenes[] = {
    {"an unknown key is named at the key, with the nearest",
     "\"end\": 5}",
     "\"end\": 5, \"sefty\": 0.1}",
     "/time/sefty",
     18,
     22,
     {"unknown key", "did you mean \"safety\"", "allowed here: end, dt, safety"}},
    {"an unknown section is named",
     "\"loads\":",
     "\"laods\":",
     "/laods",
     16,
     3,
     {"unknown key", "did you mean \"loads\"", "bodies", "time"}},
    {"an unknown format is named",
     "\"talus\": 1",
     "\"talus\": 2",
     "/talus",
     2,
     12,
     {"format 2 is unknown", "reads 1"}},
    {"a missing format is named", "\"talus\": 1,", "", "", 1, 1, {"required key \"talus\""}},
    {"a wrong type is named with the unit",
     "\"end\": 5}",
     "\"end\": \"long\"}",
     "/time/end",
     18,
     19,
     {"\"long\"", "a number [s]", "greater than 0"}},
    {"a number out of range is named with the range",
     "\"end\": 5}",
     "\"end\": 5, \"safety\": 0.9}",
     "/time/safety",
     18,
     32,
     {"0.9 is out of range", "at most 0.4"}},
    {"a missing number is named with unit and range",
     "{\"end\": 5}",
     "{}",
     "/time",
     18,
     11,
     {"required key \"end\"", "[s]", "greater than 0"}},
    {"a time step that is neither number nor auto is named",
     "\"end\": 5}",
     "\"end\": 5, \"dt\": \"fast\"}",
     "/time/dt",
     18,
     28,
     {"\"fast\"", "\"auto\"", "[s]"}},
    {"frames off the history are named with a multiple",
     "\"end\": 5}",
     "\"end\": 5}, \"output\": {\"history\": 0.1, \"frames\": 0.25}",
     "/output/frames",
     18,
     60,
     {"0.25 s is no whole multiple", "0.1 s"}},
    {"a history of too many rows is named",
     "\"end\": 5}",
     "\"end\": 5}, \"output\": {\"history\": 1e-12}",
     "/output/history",
     18,
     45,
     {"5e+12 rows"}},
    {"a section of another type is named",
     "{\"end\": 5}",
     "5",
     "/time",
     18,
     11,
     {"5 is not allowed here", "object"}},
    {"gravity of three components is named",
     "[0, -10]",
     "[0, 0, -10]",
     "/gravity",
     3,
     14,
     {"[x, y]", "m/s2"}},
    {"a negative density is named",
     "\"density\": 7800",
     "\"density\": -1",
     "/materials/steel/density",
     6,
     26,
     {"-1 is out of range", "[kg/m3]", "greater than 0"}},
    {"a parameter the material requires is named",
     ", \"young_modulus\": 1e10",
     "",
     "/materials/rock",
     5,
     13,
     {"required key \"young_modulus\"", "[Pa]", "at least 1", "Stiffness of the material"}},
    {"an unknown material model is named with the nearest",
     "\"linear_elastic\"",
     "\"linear_elastik\"",
     "/materials/rock/model",
     5,
     40,
     {"no material \"linear_elastik\"", "did you mean \"linear_elastic\"", "installed: linear_elastic"}},
    {"an unknown law is named with the nearest",
     "{\"model\": \"shear\"",
     "{\"model\": \"sheer\"",
     "/contact/model",
     8,
     24,
     {"\"sheer\"", "did you mean \"shear\"", "installed: shear, smooth"}},
    {"a section of a law that is not installed is named",
     "\"shear\": {\"friction_rule\": \"paper\"}",
     "\"smoth\": {}",
     "/contact/smoth",
     8,
     33,
     {"did you mean \"smooth\"", "model, roles, shear, smooth"}},
    {"a choice that does not exist is named",
     "\"paper\"",
     "\"papr\"",
     "/contact/shear/friction_rule",
     8,
     60,
     {"\"papr\"", "did you mean \"paper\"", "\"return_mapping\" or \"paper\""}},
    {"a flag that is no truth value is named",
     "\"friction_rule\": \"paper\"",
     "\"strict\": 1",
     "/contact/shear/strict",
     8,
     53,
     {"1 is not allowed here", "true or false"}},
    {"a law not chosen is checked too",
     "\"friction_rule\": \"paper\"}",
     "\"friction_rule\": \"paper\"}, \"smooth\": {\"x\": 1}",
     "/contact/smooth/x",
     8,
     81,
     {"unknown key"}},
    {"contact that is missing where bodies can meet is named",
     "\"contact\": {\"model\": \"shear\", \"shear\": {\"friction_rule\": \"paper\"}},",
     "",
     "",
     1,
     1,
     {"required key \"contact\""}},
    {"an interface key no law reads is named",
     "\"normal_damping\": 0.3",
     "\"normal_damping\": 0.3, \"friction_angel\": 3",
     "/interfaces/0/friction_angel",
     10,
     100,
     {"did you mean \"friction_angle\"", "cohesion"}},
    {"an interface key that only the vocabulary knows is held to its range",
     "\"normal_damping\": 0.3",
     "\"normal_damping\": 0.3, \"tangential_damping\": 11",
     "/interfaces/0/tangential_damping",
     10,
     122,
     {"11 is out of range", "[-] from 0 to 10"}},
    {"parameters that the law's constructor refuses are named with its words",
     "\"friction_rule\": \"paper\"",
     "\"friction_rule\": \"paper\", \"strict\": true",
     "/contact/shear",
     8,
     42,
     {"contact law \"shear\"", "strict needs return_mapping"}},
    {"parameters that the material's constructor refuses are named with its words",
     "\"young_modulus\": 1e10",
     "\"young_modulus\": 1e10, \"poisson_ratio\": 0.49",
     "/materials/rock",
     5,
     13,
     {"material \"linear_elastic\"", "poisson_ratio locks the block"}},
    {"parameters that the constructor of a body's cover refuses are named with its words",
     "\"material\": \"rock\"",
     "\"material\": \"rock\", \"cover\": {\"model\": \"block\", \"tilt\": 180}",
     "/bodies/1/cover",
     14,
     97,
     {"cover \"block\"", "upside down"}},
    {"an interface that lacks what the law requires is named",
     ", \"normal_damping\": 0.3",
     "",
     "/interfaces/0",
     10,
     5,
     {"required key \"normal_damping\"", "[-]", "from 0 to 10"}},
    {"a friction angle out of range is named in degrees",
     "\"friction_angle\": 20",
     "\"friction_angle\": 90",
     "/interfaces/0/friction_angle",
     10,
     73,
     {"90 is out of range", "[deg] from 0 to 89"}},
    {"an interface of an unknown material is named",
     "[\"*\", \"*\"]",
     "[\"*\", \"rok\"]",
     "/interfaces/0/between/1",
     10,
     23,
     {"\"rok\"", "did you mean \"rock\"", "top"}},
    {"an interface of an unknown surface of a body is named",
     "[\"*\", \"*\"]",
     "[\"*\", \"ramp/tap\"]",
     "/interfaces/0/between/1",
     10,
     23,
     {"did you mean \"ramp/top\""}},
    {"a pair that no row covers is named",
     "[\"*\", \"*\"]",
     "[\"rock\", \"top\"]",
     "/interfaces",
     9,
     17,
     {"no row covers", "\"steel\" against \"rock\""}},
};

}  // namespace

TEST_CASE("every mistake in sections and tables is told with its place, its pointer and what would be right",
          "[scene]") {
  for (const BadScene& bad : mistaken_scenes) {
    DYNAMIC_SECTION(bad.requirement) {
      const std::string text = sample::good_but(bad.old_text, bad.new_text);
      const std::vector<Mistake> found = sample::mistakes(text);
      REQUIRE(!found.empty());
      check(found[0], bad, text);
    }
  }
}

TEST_CASE("all mistakes of a scene are told at once, in the order of the file", "[scene]") {
  std::string text = sample::good_but("\"end\": 5", "\"end\": -5, \"step\": 1");
  text.replace(text.find("[0, -10]"), 8, "[0, \"g\"]");
  text.replace(text.find("\"steel\", \"fixed\""), 7, "\"stel\"");
  const std::vector<Mistake> found = sample::mistakes(text);
  REQUIRE(found.size() == 4);
  CHECK(found[0].pointer == "/gravity/1");
  CHECK(found[1].pointer == "/bodies/0/material");
  CHECK(found[2].pointer == "/time/end");
  CHECK(found[3].pointer == "/time/step");
}

TEST_CASE("the error holds one line per mistake: file, line, column, pointer, words", "[scene]") {
  Registry registry = sample::registry();
  const std::string text = sample::good_but("\"end\": 5", "\"end\": -5, \"step\": 1");
  CHECK_THROWS_WITH(read_scene_text(text, "scene.json", registry),
                    "scene.json:18:19: /time/end: -5 is out of range: expected a number [s] greater than 0\n"
                    "scene.json:18:23: /time/step: unknown key; allowed here: end, dt, safety");
}

TEST_CASE("of very many mistakes the first thousand are listed, and how many more there are is said",
          "[scene]") {
  Registry registry = sample::registry();
  const auto error_of = [&](int mistakes) {
    std::string keys;
    for (int i = 0; i < mistakes; ++i) keys += ", \"k" + std::to_string(i) + "\": 1";
    try {
      read_scene_text(sample::good_but("\"end\": 5", "\"end\": 5" + keys), "scene.json", registry);
    } catch (const SceneError& error) {
      return error;
    }
    return SceneError({});
  };
  const SceneError all = error_of(1000), cut = error_of(1234);
  CHECK(all.mistakes.size() == 1000);
  CHECK(all.more == 0);
  REQUIRE(cut.mistakes.size() == 1001);
  CHECK(cut.more == 234);
  CHECK(cut.mistakes[999].pointer == "/time/k999");
  CHECK(cut.mistakes[1000].text() == "scene.json: and 234 more mistakes");
}

TEST_CASE("mistakes that say the same of one place are listed once, however many there were", "[scene]") {
  Mistakes mistakes;
  for (int i = 0; i < 100'007; ++i) mistakes.add("/blocks/0/" + std::to_string(i), "too thin");
  mistakes.move([](const std::string&) { return std::string("/blocks/0"); });
  const SceneError error = mistakes.placed(R"({"blocks": [{}]})", "scene.json", {}, {});
  REQUIRE(error.mistakes.size() == 2);  // it and what was beyond all keeping
  CHECK(error.mistakes[0].text() == "scene.json:1:13: /blocks/0: too thin");
  CHECK(error.mistakes[1].text() == "scene.json: and 7 more mistakes");
}

TEST_CASE("of two equally specific rows neither is taken", "[scene]") {
  const std::string row = "\"normal_stiffness\": 1e10, \"friction_angle\": 20, \"normal_damping\": 0.3}";
  const std::string rows =
      "{\"between\": [\"rock\", \"*\"], " + row + ",\n{\"between\": [\"steel\", \"*\"], " + row;
  const auto found = sample::mistakes(sample::good_but("{\"between\": [\"*\", \"*\"], " + row, rows));
  REQUIRE(!found.empty());
  CHECK(found[0].pointer == "/interfaces/1/between");
  CHECK(found[0].line == 11);
  CHECK_THAT(found[0].message, Catch::Contains("/interfaces/0") && Catch::Contains("more specific"));
}

TEST_CASE("a model whose library was refused says so", "[scene]") {
  Registry registry = sample::registry();
  registry.refused.push_back({"/plugins/libmylaw.so", "found ABI 7, wanted 1"});
  CHECK_THROWS_WITH(read_scene_text(sample::good_but("{\"model\": \"shear\"", "{\"model\": \"mylaw\""),
                                    "scene.json", registry),
                    Catch::Contains("/plugins/libmylaw.so was refused: found ABI 7, wanted 1"));
}

TEST_CASE("with an unknown law the mistakes in interfaces are told all the same", "[scene]") {
  std::string text = sample::good_but("{\"model\": \"shear\"", "{\"model\": \"sheer\"");
  const std::string row = "\"normal_stiffness\": 1e10, \"friction_angle\": 20, \"normal_damping\": 0.3}";
  text.replace(text.find(row), row.size(),
               "\"friction_angle\": 90, \"friction_angel\": 20, \"dilation\": 1, \"cohesion\": -1}");
  const std::vector<Mistake> found = sample::mistakes(text);
  REQUIRE(found.size() == 4);
  const BadScene expected[] = {
      {"", "", "", "/contact/model", 8, 24, {"did you mean \"shear\""}},
      {"", "", "", "/interfaces/0/friction_angle", 10, 47, {"90 is out of range", "from 0 to 89.99995"}},
      {"", "", "", "/interfaces/0/friction_angel", 10, 51, {"did you mean \"friction_angle\"", "dilation"}},
      {"", "", "", "/interfaces/0/cohesion", 10, 100, {"-1 is out of range", "[Pa]"}}};
  for (std::size_t i = 0; i < found.size(); ++i) check(found[i], expected[i], text);
}

TEST_CASE("with a law that is not named at all the keys of its interfaces are checked too", "[scene]") {
  std::string text = sample::good_but("\"model\": \"shear\", ", "");
  text.replace(text.find("\"normal_damping\": 0.3"), 16, "\"normal_dampin\"");
  const std::vector<Mistake> found = sample::mistakes(text);
  REQUIRE(found.size() == 2);
  CHECK(found[0].pointer == "/contact");
  CHECK(found[1].pointer == "/interfaces/0/normal_dampin");
}

TEST_CASE("a constructor is not asked as long as its section holds another mistake", "[scene]") {
  const auto found = sample::mistakes(sample::good_but(
      "\"friction_rule\": \"paper\"", "\"friction_rule\": \"paper\", \"strict\": true, \"strickt\": true"));
  REQUIRE(found.size() == 1);
  CHECK(found[0].pointer == "/contact/shear/strickt");
}
