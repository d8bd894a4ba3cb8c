#include "files/whole_file.hpp"
#include "output/scratch.hpp"
#include "program.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace talus;
using Catch::Matchers::Contains;

namespace {

const std::string wall = R"(// A small wall.
{"talus": 1, "title": "wall", "gravity": [0, -9.81],
 "materials": {"rock": {"model": "linear_elastic", "young_modulus": 1e10, "poisson_ratio": 0.25, "density": 2300}},
 "contact": {"model": "overlap_area"},
 "interfaces": [{"between": ["*", "*"], "tangential_stiffness": 1e10, "normal_stiffness": 1e10, "friction_angle": 30,
   "normal_damping": 0.3, "tangential_damping": 0.3}],
 "bodies": [{"polygon": [[-1, -1], [5, -1], [5, 0], [-1, 0]], "name": "floor", "material": "rock", "fixed": true}],
 "blocks": [{"name": "brick", "domain": [[0, 0], [4, 0], [4, 1], [0, 1]], "material": "rock",
   "bricks": {"width": 2, "height": 0.5}}],
 "monitors": [{"name": "top", "body": "brick_2"}],
 "time": {"end": 0.01}})";

}  // namespace

TEST_CASE("a scene is not replaced by its plain bodies", "[apps]") {
  const Scratch scratch;
  scratch.write("wall.json", wall);
  const Call call = call_talus(scratch.folder(), {"blocks", "wall.json", "-o", "./wall.json"});
  CHECK(call.code == 2);
  CHECK_THAT(call.err, Contains("is the scene itself"));
  CHECK(read_whole_file(scratch / "wall.json") == wall);
}

TEST_CASE("nor is a file that the scene reads", "[apps]") {
  const Scratch scratch;
  const std::string table = "t [s],a [m/s2]\n0,0\n1,1\n";
  scratch.write("quake.csv", table);
  std::string shaken = wall;
  shaken.replace(shaken.find("\"monitors\""), 0, R"("base_acceleration": [{"time": "quake.csv"}, 0],
 )");
  scratch.write("wall.json", shaken);
  for (const char* command : {"blocks", "view"}) {
    const Call call = call_talus(scratch.folder(), {command, "wall.json", "-o", "quake.csv"});
    INFO(command << ": " << call.err);
    CHECK(call.code == 2);
    CHECK_THAT(call.err, Contains("'quake.csv' is read by the scene: name another file"));
    CHECK(read_whole_file(scratch / "quake.csv") == table);
  }
}

TEST_CASE("a scene written with plain bodies reads and runs to the same bits", "[apps]") {
  const Scratch scratch;
  scratch.write("wall.json", wall);
  const Call call = call_talus(scratch.folder(), {"blocks", "wall.json", "-o", "plain.json"});
  INFO(call.err);
  REQUIRE(call.code == 0);
  CHECK(call.out.empty());
  const std::string plain = read_whole_file(scratch / "plain.json");
  CHECK_THAT(plain, Catch::StartsWith("// A small wall.\n{"));
  const auto json = nlohmann::ordered_json::parse(plain, nullptr, true, true);
  CHECK_FALSE(json.contains("blocks"));
  CHECK(json["bodies"].size() == 6);
  CHECK(json["interfaces"][0].begin().key() == "between");
  CHECK(std::next(json["interfaces"][0].begin()).key() ==
        "tangential_stiffness");  // in the order of the scene
  REQUIRE(call_talus(scratch.folder(), {"run", "wall.json", "--out", "a", "--quiet"}).code == 0);
  REQUIRE(call_talus(scratch.folder(), {"run", "plain.json", "--out", "b", "--quiet"}).code == 0);
  for (const char* file : {"history.csv", "resolved.json"})
    CHECK(read_whole_file(scratch / "a" / file) == read_whole_file(scratch / "b" / file));
}

TEST_CASE("plain bodies go to the standard output, with overrides", "[apps]") {
  const Scratch scratch;
  scratch.write("wall.json", wall);
  const Call call =
      call_talus(scratch.folder(), {"blocks", "wall.json", "--set", "/blocks/0/bricks/bond=stack"});
  REQUIRE(call.code == 0);
  CHECK(nlohmann::json::parse(call.out, nullptr, true, true)["bodies"].size() == 5);
  const Call bad =
      call_talus(scratch.folder(), {"blocks", "wall.json", "--set", "/blocks/0/bricks/bond=stak"});
  CHECK(bad.code == 2);
  CHECK(bad.out.empty());
  CHECK_THAT(bad.err, Contains("did you mean \"stack\"?"));
}

TEST_CASE("plain bodies are not written where the scene's files would be missed", "[apps]") {
  const Scratch scratch;
  std::filesystem::create_directory(scratch / "other");
  std::string text = wall;
  const std::string gravity = "\"gravity\": [0, -9.81]";
  text.replace(text.find(gravity), gravity.size(), "\"base_acceleration\": [{\"time\": \"quake.csv\"}, 0]");
  scratch.write("wall.json", text);
  scratch.write("quake.csv", "0,1\n1,2\n");
  const Call away = call_talus(scratch.folder(), {"blocks", "wall.json", "-o", "other/plain.json"});
  CHECK(away.code == 2);
  CHECK_THAT(away.err, Contains("names files by paths"));
  CHECK_FALSE(std::filesystem::exists(scratch / "other" / "plain.json"));
  CHECK(call_talus(scratch.folder(), {"blocks", "wall.json", "-o", "plain.json"}).code == 0);
  CHECK(call_talus(scratch.folder(), {"blocks", "wall.json", "-o", "other"}).code == 2);
}
