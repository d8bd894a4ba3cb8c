#include "study/findings.hpp"

#include "output/input_error.hpp"
#include "study/sample_runs.hpp"
#include "study/study_charts.hpp"
#include "study/study_text.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace talus;
using Catch::Matchers::Contains;

TEST_CASE("A study's errors are those against its finest run, and give its front and its order", "[study]") {
  const std::vector<StudyRun> runs = stepped({run_of(0.16, 1, 10), run_of(0.04, 2, 20), run_of(0.01, 4, 40),
                                              run_of(0, 0.5, 5, "stopped"), run_of(0, 9, 90)});
  const StudyFindings findings = find_out(sample_steps(), runs, sample_column, std::nullopt);
  CHECK(findings.reference == 4u);
  CHECK(*findings.runs[0].error == Approx(0.08));
  CHECK(*findings.runs[1].rms == Approx(0.04));
  CHECK_FALSE(findings.runs[3].error);
  CHECK_FALSE(findings.runs[4].error);
  for (const std::size_t i : {0, 1, 2}) CHECK(findings.runs[i].on_front);
  REQUIRE(findings.orders.size() == 1);
  CHECK(findings.orders[0].runs == std::vector<std::size_t>{0, 1, 2});
  CHECK(findings.orders[0].orders[0] == Approx(2));
  CHECK(findings.orders[0].orders[1] == Approx(2));
  CHECK(findings.orders[0].fit == Approx(2));
  CHECK(cheapest_within(findings, runs, 0.03) == 1u);
  CHECK(cheapest_within(findings, runs, 0.5) == 0u);
  CHECK_FALSE(cheapest_within(findings, runs, 1e-6));

  const std::string table = study_table(sample_steps(), runs, findings);
  CHECK_THAT(table, Contains("dt=5e-4 (most work)") && Contains("2.00 2.00; all: 2.00") &&
                        Contains("failed: dt=8e-3: it <blew> up"));
  const auto json = nlohmann::json::parse(study_json(sample_steps(), runs, findings));
  CHECK(json["runs"][3]["trouble"] == "it <blew> up");
  CHECK(json["runs"][3]["error [-]"].is_null());
  CHECK_THAT(study_csv(sample_steps(), runs, findings), Contains("run,/time/dt,end,error [-]"));
  CHECK_THAT(study_svg(sample_steps(), runs, findings), Contains("dt=2e-3"));
}

TEST_CASE("The order in the time step is that in the steps that ran", "[study]") {
  // Of 4e-3 and 2e-3 s, rounded to whole steps per output, both ran with 2e-3.
  std::vector<StudyRun> runs = stepped({run_of(0.04, 2, 20), run_of(0.04, 2, 20), run_of(0.01, 4, 40),
                                        run_of(0, 0.5, 5, "stopped"), run_of(0, 9, 90)});
  runs[0].dt = runs[1].dt;
  const StudyFindings findings = find_out(sample_steps(), runs, sample_column, std::nullopt);
  REQUIRE(findings.orders.size() == 1);
  REQUIRE(findings.orders[0].orders.size() == 1);
  CHECK(findings.orders[0].orders[0] == Approx(2));
  CHECK(findings.orders[0].fit == Approx(2));
  runs[2].dt = runs[1].dt;
  CHECK(find_out(sample_steps(), runs, sample_column, std::nullopt).orders.empty());
}

TEST_CASE("What rounding makes tells no order", "[study]") {
  // Errors of 4e-13, 2e-13 and 1e-13 fall with the step, and yet are none of its.
  const std::vector<StudyRun> runs = stepped({run_of(8e-13, 1, 10), run_of(4e-13, 2, 20),
                                              run_of(2e-13, 4, 40), run_of(1e-13, 8, 80), run_of(0, 9, 90)});
  CHECK(find_out(sample_steps(), runs, sample_column, std::nullopt).orders.empty());
}

TEST_CASE("There is an order in what resolves, none in what a scene is", "[study]") {
  const std::vector<StudyRun> runs = stepped({run_of(0.16, 1, 10), run_of(0.04, 2, 20), run_of(0.01, 4, 40),
                                              run_of(0, 0.5, 5, "stopped"), run_of(0, 9, 90)});
  StudyPlan plan = sample_steps();
  for (const char* resolves : {"/cover/size", "/time/safety", "/interfaces/0/normal_stiffness"}) {
    plan.pointers[0] = resolves;
    CHECK(find_out(plan, runs, sample_column, std::nullopt).orders.size() == 1);
  }
  for (const char* given : {"/interfaces/0/friction_angle", "/damping", "/gravity/1"}) {
    plan.pointers[0] = given;
    CHECK(find_out(plan, runs, sample_column, std::nullopt).orders.empty());
  }
}

TEST_CASE("A run that is dearer and farther is not on the front", "[study]") {
  const std::vector<StudyRun> runs{run_of(0.16, 1, 10), run_of(0.2, 2, 20), run_of(0.01, 4, 40),
                                   run_of(0.01, 5, 50), run_of(0, 9, 90)};
  const StudyFindings findings = find_out(sample_steps(), runs, sample_column, std::nullopt);
  CHECK(findings.runs[0].on_front);
  CHECK_FALSE(findings.runs[1].on_front);
  CHECK(findings.runs[2].on_front);
  CHECK_FALSE(findings.runs[3].on_front);
}

TEST_CASE("A study can be measured against a curve, and says where it cannot", "[study]") {
  std::vector<StudyRun> runs{run_of(0.16, 1, 10), run_of(0.04, 2, 20), run_of(0.01, 4, 40),
                             run_of(0.08, 2, 2), run_of(0.02, 9, 90)};
  Series reference = run_of(0, 0, 0).history;
  const StudyFindings findings = find_out(sample_steps(), runs, sample_column, reference);
  CHECK_FALSE(findings.reference);
  CHECK(*findings.runs[4].error == Approx(0.01));
  reference.names = {"other.speed [m/s]"};
  CHECK_THROWS_WITH(find_out(sample_steps(), runs, sample_column, reference),
                    Contains("it has 'other.speed [m/s]'"));
  reference = run_of(0, 0, 0).history;
  for (double& value : reference.values[0]) value = 0;
  CHECK_THROWS_WITH(find_out(sample_steps(), runs, sample_column, reference),
                    Contains("is 0 all along in the reference"));
  for (StudyRun& each : runs) each.end = "stopped";
  CHECK_THROWS_AS(find_out(sample_steps(), runs, sample_column, std::nullopt), InputError);
}
