#include "compare/report.hpp"
#include "files/input_error.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace talus;
using Catch::Matchers::Contains;

namespace {

ComparisonOrder example_order() {
  ComparisonOrder order;
  order.variation = parse_variation("/contact/model=overlap_area,vertex_edge");
  order.scenes.resize(2);
  for (Scene& scene : order.scenes) {
    scene.file = "incline.json";
    scene.time.end = 2;
    scene.monitors = {{"block", 0, {}, {"speed"}}};
  }
  order.scenes[0].tolerances = {{"block", "speed", false, 0.5, {}, {}}};
  order.moments = {0.5};
  return order;
}

ComparedRun run_of(const std::string& value, std::vector<double> speeds, double cpu, double own_dt) {
  ComparedRun run;
  run.value = value;
  run.own_dt = own_dt;
  run.own_steps = 2 / own_dt;
  run.result.history = {{0, 1, 2}, {"block.speed [m/s]"}, {speeds}};
  run.result.history.time.resize(speeds.size());
  run.result.stepping.cpu = cpu;
  run.result.summary.steps = 1000;
  run.result.summary.dt = 0.002;
  return run;
}

Comparison example_comparison() {
  Comparison comparison;
  comparison.runs = {run_of("overlap_area", {0, 1, 2}, 2, 0.002),
                     run_of("vertex_edge", {0, 1.25, 1.75}, 1, 0.004)};
  comparison.common_dt = 0.002;
  return comparison;
}

}  // namespace

TEST_CASE("compare.csv puts the runs side by side", "[compare][report]") {
  Comparison comparison = example_comparison();
  CHECK(comparison_csv(comparison) ==
        "t [s],overlap_area/block.speed [m/s],vertex_edge/block.speed [m/s]\n0,0,0\n1,1,1.25\n2,2,1.75\n");
  comparison.runs[1].result.history = {{0, 1.5}, {"block.speed [m/s]"}, {{0, 3}}};
  CHECK(comparison_csv(comparison) ==
        "t [s],overlap_area/block.speed [m/s],vertex_edge/block.speed [m/s]\n0,0,0\n1,1,\n2,2,\n");
}

TEST_CASE("compare.json holds deviations, cost and tolerances", "[compare][report]") {
  ComparisonOrder order = example_order();
  order.reference = ReferenceFile{"curve.csv", "", {{0, 2}, {"block.speed [m/s]"}, {{0, 4}}}};
  order.scenes[0].tolerances.push_back({"block", "speed", true, {}, {}, 0.1});
  Comparison comparison = example_comparison();
  evaluate(order, comparison);
  const auto json = nlohmann::json::parse(comparison_json(order, comparison));
  const auto& column = json["deviations"]["block.speed [m/s]"];
  CHECK(column["vertex_edge"]["from_baseline"]["largest"] == 0.25);
  CHECK(column["vertex_edge"]["from_baseline"]["largest_at [s]"] == 1);
  CHECK(column["vertex_edge"]["from_baseline"]["final"] == -0.25);
  CHECK(column["vertex_edge"]["from_baseline"]["at"]["0.5"] == 0.125);
  CHECK(column["overlap_area"]["from_reference"]["largest"] == -2);
  CHECK(column["overlap_area"].contains("from_baseline") == false);
  CHECK(json["runs"][1]["cost_at_equal_dt"] == 0.5);
  CHECK(json["runs"][1]["own_steps"] == 500);
  CHECK(json["runs"][1]["cost_at_own_dt"] == 0.25);
  REQUIRE(json["tolerances"].size() == 3);
  CHECK(json["tolerances"][0]["verdict"] == "held");
  CHECK(json["tolerances"][1]["verdict"] == "broken");
  CHECK(json["tolerances_held"] == false);
}

TEST_CASE("a tolerance broken by a hair is broken", "[compare][report]") {
  ComparisonOrder order = example_order();
  Comparison comparison = example_comparison();
  order.scenes[0].tolerances[0].largest = 0.25;
  evaluate(order, comparison);
  CHECK(comparison.tolerances_held());
  order.scenes[0].tolerances[0].largest = 0.2499999;
  comparison = example_comparison();
  evaluate(order, comparison);
  CHECK_FALSE(comparison.tolerances_held());
  CHECK_THAT(comparison_table(order, comparison), Contains("BROKEN") && Contains("block.speed"));
}

TEST_CASE("of runs that were cut short no tolerance is held, and no cost at their own step is told",
          "[compare][report]") {
  ComparisonOrder order = example_order();
  Comparison comparison = example_comparison();
  order.scenes[0].tolerances[0].largest = 0.5;
  SECTION("stopped") {
    comparison.runs[1].result.end = RunEnd::stopped;
  }
  SECTION("the baseline") {
    comparison.runs[0].result.end = RunEnd::interrupted;
  }
  SECTION("before the first step") {
    comparison.runs[1].result.end = RunEnd::interrupted;
    comparison.runs[1].result.summary.steps = 0;
  }
  for (ComparedRun& run : comparison.runs) {
    if (run.result.end != RunEnd::finished) run.own_steps.reset();
  }
  const bool stepped = comparison.runs[1].result.summary.steps > 0;
  evaluate(order, comparison);
  CHECK_FALSE(comparison.tolerances_held());
  const auto json = nlohmann::json::parse(comparison_json(order, comparison));
  CHECK(json["tolerances"][0]["verdict"] == "cut short");
  CHECK(json["runs"][1]["cost_at_own_dt"].is_null());
  CHECK(json["runs"][1]["cost_at_equal_dt"].is_null() == !stepped);
  CHECK_THAT(comparison_table(order, comparison), Contains("cut short") && !Contains("nan"));
}

TEST_CASE("a tolerance that cannot be checked is told of", "[compare][report]") {
  ComparisonOrder order = example_order();
  order.scenes[0].tolerances = {{"block", "speed", true, 0.5, {}, {}}};
  Comparison comparison = example_comparison();
  evaluate(order, comparison);
  REQUIRE(comparison.warnings.size() == 2);
  CHECK_THAT(comparison.warnings[0],
             Contains("--at 0.5: 'overlap_area' and 'vertex_edge' do not both have a row"));
  CHECK_THAT(comparison.warnings[1], Contains("--reference"));
}

TEST_CASE("a run that was stopped between rows is warned of", "[compare][report]") {
  const ComparisonOrder order = example_order();
  Comparison comparison = example_comparison();
  RunResult& result = comparison.runs[1].result;
  result.end = RunEnd::stopped;
  result.time = 1.5;
  result.history = {{0, 1}, {"block.speed [m/s]"}, {{0, 1}}};
  SECTION("between rows") {
    evaluate(order, comparison);
    CHECK_THAT(comparison.warnings.back(),
               Contains("'vertex_edge' was stopped at t = 1.5 s and is compared up to t = 1 s"));
  }
  SECTION("in the moment of its last row") {
    result.history.time.back() = 1.5;
    evaluate(order, comparison);
    for (const std::string& warning : comparison.warnings) CHECK_THAT(warning, !Contains("was stopped"));
  }
  SECTION("before its first") {
    result.history = {{}, {"block.speed [m/s]"}, {{}}};
    evaluate(order, comparison);
    CHECK(comparison.warnings.front() == "'vertex_edge' has no time in common with 'overlap_area'");
  }
}

TEST_CASE("monitors that one run has are told of where others lack them", "[compare][report]") {
  ComparisonOrder order = example_order();
  order.scenes[1].monitors.push_back({"other", 0, {}, {"ux"}});
  Comparison comparison = example_comparison();
  evaluate(order, comparison);
  CHECK_THAT(comparison.warnings[0],
             Contains("'vertex_edge' has, and 'overlap_area' has not") && Contains("other.ux [m]"));
  order.scenes[1].monitors.erase(order.scenes[1].monitors.begin());
  CHECK_THROWS_WITH(check_order(order),
                    Contains("'overlap_area' and 'vertex_edge' have no column in common"));
}

TEST_CASE("what is told between rows is warned of", "[compare][report]") {
  ComparisonOrder order = example_order();
  order.moments = {1};
  Comparison comparison = example_comparison();
  comparison.runs[1].result.history = {{0, 0.7, 1.7}, {"block.speed [m/s]"}, {{0, 1, 3}}};
  evaluate(order, comparison);
  REQUIRE(comparison.warnings.size() == 2);
  CHECK_THAT(comparison.warnings[0], Contains("'vertex_edge' has rows at other times than 'overlap_area'"));
  CHECK_THAT(comparison.warnings[1], Contains("--at 1: "));
}

TEST_CASE("an order that compares nothing is refused", "[compare][report]") {
  ComparisonOrder order = example_order();
  CHECK_NOTHROW(check_order(order));
  order.moments = {order.scenes[0].time.end, 99};
  CHECK_THROWS_WITH(check_order(order), Contains("--at 99"));
  order.moments.pop_back();
  order.reference = ReferenceFile{"curve.csv", "", {{0}, {"block.speed [km/h]"}, {{0}}}};
  CHECK_THROWS_WITH(check_order(order), Contains("km/h") && Contains("block.speed [m/s]"));
  order.reference.reset();
  order.scenes.pop_back();
  CHECK_THROWS_WITH(check_order(order), Contains("two values"));
  order = example_order();
  for (Scene& scene : order.scenes) scene.monitors.clear();
  CHECK_THROWS_AS(check_order(order), InputError);
}

TEST_CASE("a tolerance is held by curves that go to the end alone", "[compare][report]") {
  ComparisonOrder order = example_order();
  order.scenes[0].time.end = 2;
  Comparison comparison = example_comparison();
  const auto verdict = [&] {
    comparison.tolerances.clear();
    comparison.deviations.clear();
    evaluate(order, comparison);
    return comparison.tolerances.back().checks.back().verdict;
  };
  order.scenes[0].tolerances = {{"block", "speed", true, {}, {}, 0.5}};
  order.reference = ReferenceFile{"curve.csv", "", {{0, 2}, {"block.speed [m/s]"}, {{0, 2}}}};
  CHECK(verdict() == ToleranceVerdict::held);
  order.reference->series.time = {0, 1};
  CHECK(verdict() == ToleranceVerdict::cut_short);
  order.scenes[0].tolerances[0].against_reference = false;
  order.reference->series = {{}, {"block.speed [m/s]"}, {{}}};  // a file of a head alone
  CHECK(verdict() == ToleranceVerdict::held);
  order.scenes[0].tolerances[0].against_reference = true;
  evaluate(order, comparison);
  CHECK(comparison.tolerances.back().checks.back().verdict == ToleranceVerdict::unchecked);
  CHECK_FALSE(comparison.tolerances_held());
  CHECK_THAT(comparison_table(order, comparison), Catch::Contains("not checked"));
  order.scenes[0].tolerances[0].against_reference = false;
  comparison.runs[0].result.history.time = {0, 0.5, 1};
  CHECK(verdict() == ToleranceVerdict::cut_short);
}
