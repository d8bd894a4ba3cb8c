#include "study/plan.hpp"

#include "files/input_error.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <set>
#include <utility>

using namespace talus;
using Catch::Matchers::Contains;

TEST_CASE("A grid holds all combinations, the last variation changing fastest", "[study]") {
  const StudyPlan plan = grid({{"/a", {"1", "2"}}, {"/b", {"x", "y", "z"}}});
  CHECK(plan.pointers == std::vector<std::string>{"/a", "/b"});
  std::vector<std::string> points;
  for (const StudyPoint& point : plan.points) points.push_back(point.values[0] + point.values[1]);
  CHECK(points == std::vector<std::string>{"1x", "1y", "1z", "2x", "2y", "2z"});
  const std::vector<Override> overrides = plan.overrides(plan.points[4]);
  CHECK(overrides.at(1).pointer == "/b");
  CHECK(overrides.at(1).value == "y");
}

TEST_CASE("A grid that is too large or has ranges is refused", "[study]") {
  const std::vector<std::string> many(101, "1");
  CHECK_THROWS_WITH(grid({{"/a", many}, {"/b", many}}), Contains("more than 10000 runs"));
  CHECK_THROWS_WITH(grid({{"/a", {"1:2"}}}), Contains("--sample"));
}

TEST_CASE("A Latin hypercube meets each stratum once", "[study]") {
  const std::size_t count = 8;
  const StudyPlan plan =
      latin_hypercube({{"/even", {"2:3"}}, {"/ratio", {"1e2:1e10"}}, {"/word", {"a", "b"}}}, count, 7);
  std::set<int> even, ratio;
  int words = 0;
  for (const StudyPoint& point : plan.points) {
    even.insert(static_cast<int>((std::stod(point.values[0]) - 2) * count));
    ratio.insert(static_cast<int>(std::log10(std::stod(point.values[1])) - 2));
    words += point.values[2] == "a" ? 1 : 0;
  }
  CHECK(even.size() == count);
  CHECK(ratio.size() == count);
  CHECK(words == 4);
  CHECK(latin_hypercube({{"/word", {"a", "b"}}}, count, 7).points.size() == 2);
  CHECK(latin_hypercube({{"/even", {"2:3"}}}, count, 7).points[3].values[0] == plan.points[3].values[0]);
  CHECK(latin_hypercube({{"/even", {"2:3"}}}, count, 8).points[3].values[0] != plan.points[3].values[0]);
}

TEST_CASE("Samples of a narrow range far from zero are as many as asked for, each within it", "[study]") {
  for (const auto& [low, high] : {std::pair{"1234567.1", "1234567.4"},
                                  {"-1234567.4", "-1234567.1"},
                                  {"2.71828182845", "2.71828182846"},
                                  {"0.1234567", "0.9876543"}}) {
    const StudyPlan plan = latin_hypercube({{"/a", {std::string(low) + ":" + high}}}, 20, 7);
    CHECK(plan.points.size() == 20);
    for (const StudyPoint& point : plan.points) {
      CHECK(std::stod(point.values[0]) >= std::stod(low));
      CHECK(std::stod(point.values[0]) <= std::stod(high));
    }
  }
}

TEST_CASE(
    "Samples without a number or of a range without an extent are refused, and what merely looks like one is "
    "a "
    "value",
    "[study]") {
  for (const char* range : {"3:2", "2:2", "1:inf", "nan:2"})
    CHECK_THROWS_WITH(latin_hypercube({{"/a", {range}}}, 4, 7),
                      "--vary /a=" + std::string(range) + ": a range is low:high, two numbers");
  for (const std::size_t count : {0, 10001})
    CHECK_THROWS_WITH(latin_hypercube({{"/a", {"1:2"}}}, count, 7),
                      "--sample " + std::to_string(count) + ": allowed are 1 to 10000");
  for (const char* range : {"-1e308:1e308", "1e-300:1e10"})
    CHECK_THROWS_WITH(latin_hypercube({{"/a", {range}}}, 4, 7), Contains("too wide to be divided"));
  CHECK(latin_hypercube({{"/a", {"c:d"}}}, 2, 7).points[0].values[0] == "c:d");
  CHECK(grid({{"/a", {"x:", "1:2"}}}).points.size() == 2);  // of two values none is a range
}
