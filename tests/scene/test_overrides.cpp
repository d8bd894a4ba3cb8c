#include "scene/sample.hpp"

#include <catch2/catch.hpp>

using namespace talus;

namespace {

ReadOptions set(std::vector<Override> overrides) {
  return {std::move(overrides), false};
}

}  // namespace

TEST_CASE("--set writes numbers, words and lists before validation", "[scene]") {
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
