#include "scene/sample.hpp"

#include <catch2/catch.hpp>

using namespace talus;

namespace {

ReadOptions set(std::vector<Override> overrides) {
  return {std::move(overrides), false};
}

}  // namespace

TEST_CASE("Overrides write numbers, words and lists before validation", "[scene]") {
  const Scene scene = sample::read(sample::good, set({{"/time/dt", "1e-4"},
                                                      {"/contact/shear/friction_rule", "return_mapping"},
                                                      {"/bodies/1/polygon/2/1", "1.5"},
                                                      {"/gravity", "[1, 2]"},
                                                      {"/loads", "[]"},
                                                      {"/title", "two words"}}));
  CHECK(scene.time.dt == 1e-4);
  CHECK(scene.contact.values[0] == 0);
  CHECK(scene.bodies[1].outer.vertices[2].y == 1.5);
  CHECK(scene.gravity.x == 1);
  CHECK(scene.loads.empty());
  CHECK(scene.title == "two words");
}

TEST_CASE("a --set takes numbers that JSON does not know", "[scene]") {
  for (const auto& [written, due] :
       {std::pair{".5", 0.5}, {"+2", 2.0}, {"3.", 3.0}, {"-.25e1", -2.5}, {"+.5E-1", 0.05}}) {
    CAPTURE(written);
    CHECK(sample::read(sample::good, set({{"/gravity/0", written}})).gravity.x == due);
  }
  for (const char* written : {"+", ".", "1-2", "+-1", "2..5", "1e", "++2"}) {
    CAPTURE(written);
    CHECK(sample::mistakes(sample::good, set({{"/gravity/0", written}})).size() == 1);
    CHECK(sample::read(sample::good, set({{"/title", written}})).title == written);
  }
}

TEST_CASE("of two --set for one value the later counts", "[scene]") {
  CHECK(sample::read(sample::good, set({{"/time/end", "1"}, {"/time/end", "2"}})).time.end == 2);
}

TEST_CASE("a mistake in a value that --set wrote points at the --set", "[scene]") {
  const auto found = sample::mistakes(sample::good, set({{"/time/dt", "-1"}}));
  REQUIRE(found.size() == 1);
  CHECK(found[0].line == 0);
  CHECK(found[0].pointer == "/time/dt");
  CHECK_THAT(found[0].text(), Catch::StartsWith("--set /time/dt=-1: /time/dt: -1 is out of range"));
}

TEST_CASE("a mistake within an object that --set wrote points at the --set", "[scene]") {
  const auto found = sample::mistakes(sample::good, set({{"/time", "{\"end\": 1, \"saftey\": 1}"}}));
  REQUIRE(found.size() == 1);
  CHECK(found[0].file == "--set /time={\"end\": 1, \"saftey\": 1}");
  CHECK(found[0].pointer == "/time/saftey");
}

TEST_CASE("a --set of a key that no table knows is an unknown key", "[scene]") {
  const auto found = sample::mistakes(sample::good, set({{"/time/dtt", "1"}}));
  REQUIRE(found.size() == 1);
  CHECK_THAT(found[0].text(),
             Catch::StartsWith("--set /time/dtt=1: /time/dtt: unknown key; did you mean \"dt\"?"));
}

TEST_CASE("a --set below something that does not exist names the nearest", "[scene]") {
  const auto found = sample::mistakes(sample::good, set({{"/contac/model", "smooth"}}));
  REQUIRE(found.size() == 1);
  CHECK(found[0].pointer == "/contac");
  CHECK_THAT(found[0].message, Catch::Contains("did you mean \"contact\"?") && Catch::Contains("bodies"));
}

TEST_CASE("a --set beyond the end of a list names the range", "[scene]") {
  const auto found = sample::mistakes(
      sample::good, set({{"/bodies/2/name", "c"}, {"/bodies/x", "c"}, {"/time/end/x", "1"}}));
  REQUIRE(found.size() == 3);
  CHECK_THAT(found[0].message, Catch::Contains("\"2\"") && Catch::Contains("from 0 to 1"));
  CHECK_THAT(found[1].message, Catch::Contains("\"x\""));
  CHECK_THAT(found[2].message, Catch::Contains("within 5"));
}

TEST_CASE("a --set that is no pointer or no whole JSON is refused", "[scene]") {
  const auto found = sample::mistakes(sample::good, set({{"time", "1"}, {"/gravity", "[1, 2"}, {"", "1"}}));
  REQUIRE(found.size() == 3);
  CHECK_THAT(found[0].message, Catch::Contains("no JSON pointer"));
  CHECK_THAT(found[1].message, Catch::Contains("ends where"));
  CHECK_THAT(found[2].message, Catch::Contains("no JSON pointer"));
}

TEST_CASE("a --set of infinity is refused", "[scene]") {
  for (const char* value : {"1e999", "inf", "NaN"}) {
    CHECK(sample::mistakes(sample::good, set({{"/time/end", value}})).size() == 1);
  }
}

TEST_CASE("a --set makes the sections on its way that a scene may leave out", "[scene]") {
  const Scene scene = sample::read(sample::good, set({{"/limits/penetration", "0.1"},
                                                      {"/output/history", "0.5"},
                                                      {"/settle/duration", "2"},
                                                      {"/settle/damping", "3"},
                                                      {"/contact/smooth", "{}"},
                                                      {"/bodies/1/cover/model", "rigid"},
                                                      {"/bodies/1/drive/x", "4"},
                                                      {"/bodies/1/surfaces/base", "[0]"}}));
  CHECK(scene.limits.penetration == 0.1);
  CHECK(scene.limits.energy_residual == 0.05);
  CHECK(scene.output.history == 0.5);
  REQUIRE(scene.settle.has_value());
  CHECK(scene.settle->damping.constant == 3);
  CHECK(std::string(scene.bodies[1].cover.component->component->name) == "rigid");
  CHECK(scene.bodies[1].support.x == 4);
  const std::string law = "{\"model\": \"shear\", \"shear\": {\"friction_rule\": \"paper\"}}";
  const std::string bare = sample::good_but(law, "{\"model\": \"shear\"}");
  CHECK(sample::read(bare, set({{"/contact/shear/friction_rule", "paper"}})).contact.values[0] == 1);
}

TEST_CASE("a --set into a section of a name that nothing has names the nearest", "[scene]") {
  const auto found = sample::mistakes(sample::good, set({{"/limts/penetration", "0.1"},
                                                         {"/bodies/1/covr/model", "rigid"},
                                                         {"/contact/shaer/friction_rule", "paper"}}));
  REQUIRE(found.size() == 3);
  CHECK_THAT(found[0].text(), Catch::StartsWith("--set /limts/penetration=0.1: /limts: the scene has no "
                                                "\"limts\" here; did you mean \"limits\"?"));
  CHECK(found[1].pointer == "/bodies/1/covr");
  CHECK_THAT(found[1].message, Catch::Contains("did you mean \"cover\"?"));
  CHECK_THAT(found[2].text(),
             Catch::StartsWith("--set /contact/shaer/friction_rule=paper: /contact/shaer: unknown key") &&
                 Catch::Contains("did you mean \"shear\"?"));
}

TEST_CASE("a --set makes no sections within others and no lists, and leaves nothing behind when it fails",
          "[scene]") {
  std::string text =
      sample::good_but("\"loads\": [{\"body\": \"block\", \"point\": [2, 2], \"force\": [1, 0]}],", "");
  const auto found = sample::mistakes(
      text,
      set({{"/settle/deep/duration", "1"}, {"/loads/0/force", "[1, 0]"}, {"/materials/rok/density", "1"}}));
  REQUIRE(found.size() == 3);
  CHECK(found[0].pointer == "/settle/deep");
  CHECK(found[1].pointer == "/loads");
  CHECK(found[2].pointer == "/materials/rok");
  for (const Mistake& mistake : found) CHECK(mistake.line == 0);
}

TEST_CASE("what lacks in a section that a --set made is told of the --set", "[scene]") {
  const auto found = sample::mistakes(sample::good, set({{"/settle/duration", "1"}}));
  REQUIRE(found.size() == 1);
  CHECK_THAT(found[0].text(),
             Catch::StartsWith("--set /settle/duration=1: /settle: required key \"damping\" is missing"));
}

TEST_CASE("of two --set that fail alike each is told", "[scene]") {
  const auto found = sample::mistakes(sample::good, set({{"/contac/model", "a"}, {"/contac/roles", "b"}}));
  REQUIRE(found.size() == 2);
  CHECK(found[0].file == "--set /contac/model=a");
  CHECK(found[1].file == "--set /contac/roles=b");
}

TEST_CASE("null leaves out what stands under a key", "[scene]") {
  const std::string with_frames =
      sample::good_but("{\"end\": 5}", "{\"end\": 5}, \"output\": {\"frames\": 0.1}, \"sleep\": {}");
  REQUIRE(sample::read(with_frames).output.frames);
  CHECK_FALSE(sample::read(with_frames, set({{"/output/frames", "null"}})).output.frames);
  CHECK_FALSE(sample::read(with_frames, set({{"/sleep", "null"}})).sleep);
  CHECK_FALSE(
      sample::read(sample::good, set({{"/sleep", "null"}})).sleep);  // what may be left out need not be there
  CHECK(sample::read(sample::good, set({{"/sleep", "{}"}})).sleep);
  const auto why = [](const std::string& pointer) {
    const auto found = sample::mistakes(sample::good, set({{pointer, "null"}}));
    REQUIRE(found.size() == 1);
    return found[0].message;
  };
  CHECK_THAT(why("/slep"), Catch::Contains("no \"slep\" here: null leaves out what is there"));
  CHECK_THAT(why("/settle/until"), Catch::Contains("no \"until\" here"));
  CHECK_THAT(why("/bodies/0"), Catch::Contains("entries of lists stay"));
  CHECK_THAT(why("/time"), Catch::Contains("required key \"time\" is missing"));
}
