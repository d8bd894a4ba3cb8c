#include "scene/bad_scene.hpp"

#include <nlohmann/json.hpp>

#include <catch2/catch.hpp>

using namespace talus;
using nlohmann::json;
using talus::sample::BadPart;
using talus::sample::good_with;

namespace {

const BadPart bad_timings[] = {
    {"a damping that does not exist",
     R"("damping": "adaptiv")",
     "/damping",
     "\"adaptiv\"",
     {"\"adaptiv\" is not allowed here", "did you mean \"adaptive\"", "\"kinetic\"", "[1/s] of at least 0"}},
    {"a negative damping", R"("damping": -1)", "/damping", "-1", {"-1 is out of range", "at least 0"}},
    {"a damping that is no number", R"("damping": [1])", "/damping", "[1]", {"[1] is not allowed here"}},
    {"a settle stage without damping",
     R"("settle": {"duration": 1})",
     "/settle",
     "{\"duration\"",
     {"required key \"damping\"", "[1/s]"}},
    {"a settle stage with no damping at all",
     R"("settle": {"duration": 1, "damping": 0})",
     "/settle/damping",
     "0",
     {"0 is out of range", "greater than 0"}},
    {"a settle stage with a damping that does not exist",
     R"("settle": {"duration": 1, "damping": "critical"})",
     "/settle/damping",
     "\"critical\"",
     {"\"adaptive\", \"kinetic\" or a number [1/s]"}},
    {"a ratio beyond one",
     R"("settle": {"duration": 1, "damping": 1, "until": 2})",
     "/settle/until",
     "2",
     {"2 is out of range", "at most 1"}},
    {"a ratio of zero",
     R"("settle": {"duration": 1, "damping": 1, "until": 0})",
     "/settle/until",
     "0",
     {"0 is out of range", "greater than 0"}},
    {"a speed of rest that is none",
     R"("sleep": {"speed": 0})",
     "/sleep/speed",
     "0",
     {"0 is out of range", "[m/s] greater than 0"}},
    {"sleep after no time", R"("sleep": {"after": 0})", "/sleep/after", "0", {"[s] greater than 0"}},
    {"sleep with an acceleration that is no number",
     R"("sleep": {"acceleration": "small"})",
     "/sleep/acceleration",
     "\"small\"",
     {"[m/s2]"}},
    {"sleep that is no section", R"("sleep": true)", "/sleep", "true", {"true is not allowed here"}},
    {"stick that is no truth value",
     R"("settle": {"duration": 1, "damping": 1, "hold_stick": "no"})",
     "/settle/hold_stick",
     "\"no\"",
     {"true or false"}},
};

/// A single body, which meets nothing.
std::string with_safety_alone(const std::string& safety) {
  return R"({"talus": 1, "materials": {"m": {"density": 1}}, "cover": {"model": "rigid"},
      "bodies": [{"name": "a", "polygon": [[0, 0], [1, 0], [0, 1]], "material": "m"}],
      "time": {"end": 1, "safety": )" +
         safety + "}}";
}

}  // namespace

TEST_CASE("every mistake about damping and settling is told with its place", "[scene]") {
  for (const BadPart& bad : bad_timings) {
    DYNAMIC_SECTION(bad.requirement) {
      sample::check_alone(bad, good_with(bad.part));
    }
  }
}

TEST_CASE("damping is a number, adaptive or kinetic", "[scene]") {
  const auto damping = [](const char* written) {
    const Scene scene = sample::read(good_with("\"damping\": " + std::string(written)));
    CHECK(json::parse(scene.resolved)["damping"] == json::parse(written));
    return scene.damping;
  };
  CHECK(damping("3").kind == Damping::Kind::constant);
  CHECK(damping("3").constant == 3);
  CHECK(damping("\"adaptive\"").kind == Damping::Kind::adaptive);
  CHECK(damping("\"kinetic\"").kind == Damping::Kind::kinetic);
}

TEST_CASE("settling has its own damping, and may end early and let friction slip", "[scene]") {
  const Scene plain = sample::read(good_with(R"("settle": {"duration": 2, "damping": 5})"));
  CHECK(plain.settle->damping.constant == 5);
  CHECK_FALSE(plain.settle->until.has_value());
  CHECK(plain.settle->hold_stick);
  const Scene scene = sample::read(
      good_with(R"("settle": {"duration": 2, "damping": "kinetic", "until": 1e-4, "hold_stick": false})"));
  CHECK(scene.settle->damping.kind == Damping::Kind::kinetic);
  CHECK(scene.settle->until == 1e-4);
  CHECK_FALSE(scene.settle->hold_stick);
  CHECK(scene.damping.kind == Damping::Kind::constant);
  CHECK(sample::read(scene.resolved).resolved == scene.resolved);
}

TEST_CASE("islands sleep only where a scene lets them", "[scene]") {
  CHECK_FALSE(sample::read(sample::good).sleep.has_value());
  const Scene plain = sample::read(good_with(R"("sleep": {})"));
  REQUIRE(plain.sleep.has_value());
  CHECK(plain.sleep->speed == 1e-5);
  CHECK(plain.sleep->acceleration == 1e-3);
  CHECK(plain.sleep->after == 0.05);
  const Scene scene =
      sample::read(good_with(R"("sleep": {"speed": 1e-4, "acceleration": 0.02, "after": 0.3})"));
  CHECK(scene.sleep->speed == 1e-4);
  CHECK(scene.sleep->acceleration == 0.02);
  CHECK(scene.sleep->after == 0.3);
  CHECK(sample::read(scene.resolved).resolved == scene.resolved);
}

TEST_CASE("the share of the critical step is larger where no bodies meet", "[scene]") {
  CHECK(sample::read(with_safety_alone("0.9")).time.safety == 0.9);
  const auto beyond = sample::mistakes(with_safety_alone("0.91"));
  REQUIRE(beyond.size() == 1);
  CHECK_THAT(beyond[0].message, Catch::Contains("0.91 is out of range") && Catch::Contains("at most 0.9"));
  CHECK(sample::mistakes(sample::good, {{{"/time/safety", "0.4"}}, false}).empty());
  const auto meeting = sample::mistakes(sample::good, {{{"/time/safety", "0.41"}}, false});
  REQUIRE(meeting.size() == 1);
  CHECK(meeting[0].pointer == "/time/safety");
  CHECK_THAT(meeting[0].message,
             Catch::Contains("0.41 is out of range") && Catch::Contains("at most 0.4 where bodies can meet"));
}

TEST_CASE("a quake that sets in before t = 0 is told", "[scene]") {
  const auto warnings = [](const std::string& ground, const std::string& settle) {
    return sample::read(sample::good_with(settle + "\"base_acceleration\": [" + ground + ", 0]")).warnings;
  };
  const std::string settle = R"("settle": {"duration": 1, "damping": 5},)";
  const std::vector<std::string> jump = warnings(R"({"scale": -4, "time": [[0.3, 1], [0.31, 0]]})", settle);
  REQUIRE(jump.size() == 1);
  CHECK_THAT(jump[0], Catch::Contains("tables of base_acceleration act with (-4, 0) m/s²"));
  CHECK(warnings(R"({"scale": -4, "time": [[0, 0], [0.001, 1], [0.3, 0]]})", settle).empty());
  CHECK(warnings("-4", settle).empty());
  CHECK(warnings(R"([3, {"time": [[0, 0], [1, 1]]}])", settle).empty());
  CHECK(warnings(R"({"scale": -4, "time": [[0.3, 1], [0.31, 0]]})", "").empty());
}
