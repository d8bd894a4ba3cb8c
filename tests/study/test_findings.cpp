#include "study/findings.hpp"
#include "study/orders.hpp"

#include "files/input_error.hpp"
#include "simulation/simulation.hpp"
#include "study/sample_runs.hpp"
#include "study/study_charts.hpp"
#include "study/study_text.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <string>

using namespace talus;
using Catch::Matchers::Contains;

TEST_CASE("A study's errors are those against its finest run, and give its front and its order", "[study]") {
  const std::vector<StudyRun> runs = stepped({run_of(0.16, 1, 10), run_of(0.04, 2, 20), run_of(0.01, 4, 40),
                                              run_of(0, 0.5, 5, "stopped"), run_of(0.0025, 9, 90)});
  const StudyFindings findings = find_out(sample_steps(), runs, sample_column, std::nullopt);
  CHECK(findings.reference == 4u);
  CHECK(*findings.runs[0].error == Approx(0.1575 / 2.0025));
  CHECK(*findings.runs[1].rms == Approx(0.0375));
  CHECK(*findings.error_of_reference == Approx(0.0025 / 2.0025));
  CHECK_FALSE(findings.runs[3].error);
  CHECK_FALSE(findings.runs[4].error);
  for (const std::size_t i : {0, 1, 2}) CHECK(findings.runs[i].on_front);
  REQUIRE(findings.orders.size() == 1);
  CHECK(findings.orders[0].runs == std::vector<std::size_t>{0, 1, 2});
  CHECK(findings.orders[0].orders[0] == Approx(2));
  CHECK(findings.orders[0].orders[1] == Approx(2));
  CHECK(findings.orders[0].fit == Approx(2));
  CHECK(cheapest_within(findings, runs, 0.03) == 1u);
  CHECK(cheapest_within(findings, runs, 0.019) == 2u);  // 0.0187 and what the reference misses
  CHECK(cheapest_within(findings, runs, 0.5) == 0u);
  CHECK(cheapest_within(findings, runs, 0.002) == 4u);  // the reference, which misses 0.00125
  CHECK_FALSE(cheapest_within(findings, runs, 1e-6));

  const std::string table = study_table(sample_steps(), runs, findings);
  CHECK_THAT(table, Contains("dt=5e-4 (most work; misses about 0.12 % itself)") &&
                        Contains("2.00 2.00; all: 2.00") && Contains("failed: dt=8e-3: it <blew> up"));
  const auto json = nlohmann::json::parse(study_json(sample_steps(), runs, findings));
  CHECK(json["runs"][3]["trouble"] == "it <blew> up");
  CHECK(json["runs"][3]["error [-]"].is_null());
  CHECK_THAT(study_csv(sample_steps(), runs, findings), Contains("run,/time/dt,end,error [-]"));
  CHECK_THAT(study_svg(sample_steps(), runs, findings), Contains("dt=2e-3"));
}

TEST_CASE("Which of equal runs is proposed is not left to the clock", "[study]") {
  // As where another bound holds the step: the first three are one run.
  const std::vector<StudyRun> runs =
      stepped({run_of(0.04, 1.03, 10), run_of(0.04, 1, 10), run_of(0.04, 1.01, 10), run_of(0.01, 1.02, 11),
               run_of(0, 4, 40)});
  StudyFindings findings = find_out(sample_steps(), runs, sample_column, std::nullopt);
  CHECK(cheapest_within(findings, runs, 0.1) == 3u);
  findings.runs[3].error = 1;
  CHECK(cheapest_within(findings, runs, 0.1) == 0u);
}

TEST_CASE("Errors against one of several runs of equal work have no order", "[study]") {
  // As of stiffnesses at one fixed step: the first of them is no finer than the others.
  const std::vector<StudyRun> runs = stepped({run_of(0, 1, 10), run_of(0.04, 1, 10), run_of(0.01, 1, 10),
                                              run_of(0.16, 1, 10), run_of(0.0025, 1, 10)});
  const StudyFindings findings = find_out(sample_steps(), runs, sample_column, std::nullopt);
  CHECK(findings.reference == 0u);
  CHECK(findings.reference_is_one_of_many);
  CHECK(findings.orders.empty());
  CHECK(nlohmann::json::parse(study_json(sample_steps(), runs, findings))["reference_is_one_of_many"] ==
        true);
}

TEST_CASE("Orders allow for what the reference run misses, at either end of its family", "[study]") {
  for (const double order : {0.5, 1.0, 2.0, 3.0}) {
    const auto errors = [&](const std::vector<double>& sizes, double reference) {
      std::vector<double> found;
      for (const double h : sizes) found.push_back(std::abs(std::pow(h, order) - std::pow(reference, order)));
      return found;
    };
    const std::vector<double> steps{4e-3, 2e-3, 1e-3};
    const Convergence fine(steps, errors(steps, 5e-4), 5e-4);
    for (const double found : fine.between_neighbours()) CHECK(found == Approx(order).epsilon(1e-9));
    CHECK(*fine.fit() == Approx(order).epsilon(1e-6));
    // No method here is of more than second order, so nothing counts on more.
    const auto due = [&](double last, double next, double reference) {
      const double p = std::clamp(order, -2.0, 2.0) * (next > reference ? 1 : -1), r = std::pow(reference, p);
      return last * r / std::abs(std::pow(next, p) - r);
    };
    CHECK(*fine.error_of_reference() == Approx(due(errors(steps, 5e-4)[2], 1e-3, 5e-4)).epsilon(1e-6));
    // Springs are the finer the stiffer.
    std::vector<double> springs{4e9, 2e9, 1e9}, missed;
    for (const double k : springs) missed.push_back(std::pow(k, -order) - std::pow(8e9, -order));
    const Convergence stiff(springs, missed, 8e9);
    for (const double found : stiff.between_neighbours()) CHECK(found == Approx(-order).epsilon(1e-9));
    CHECK(*stiff.error_of_reference() == Approx(due(missed[0], 4e9, 8e9)).epsilon(1e-6));
    if (order <= 2) CHECK(*fine.error_of_reference() == Approx(std::pow(5e-4, order)).epsilon(1e-6));
    // Against an exact answer.
    const Convergence exact(steps, errors(steps, 0), std::nullopt);
    for (const double found : exact.between_neighbours()) CHECK(found == Approx(order).epsilon(1e-9));
    CHECK_FALSE(exact.error_of_reference());
  }
  // Errors that fall ever slower: by the last two the reference misses more than by all.
  const Convergence slower({16, 8, 4, 2}, {1, 0.1, 0.02, 0.008}, 1);
  const double last = slower.between_neighbours().back();
  CHECK(last < *slower.fit());
  CHECK(*slower.error_of_reference() == Approx(0.008 / (std::pow(2, last) - 1)).epsilon(1e-9));
  // What does not fall has no order that a reference could be off by.
  const Convergence flat({4, 2, 1}, {1, 1, 1.01}, 0.5);
  CHECK_FALSE(flat.error_of_reference());
}

TEST_CASE("Runs that differ from the reference by more than a step tell no order", "[study]") {
  const StudyPlan plan = grid({{"/time/dt", {"4e-3", "2e-3"}}, {"/contact/model", {"one", "other"}}});
  std::vector<StudyRun> runs;
  for (const StudyPoint& point : plan.points) {
    const double dt = std::stod(point.values[0]), law = point.values[1] == "one" ? 0 : 0.3;
    runs.push_back(run_of(law + 1e4 * dt * dt, 1, law + 1 / dt));
    runs.back().dt = dt;
  }
  const StudyFindings findings = find_out(plan, runs, sample_column, std::nullopt);
  CHECK(findings.orders.empty());
}

TEST_CASE("The order in the time step is that in the steps that ran", "[study]") {
  // Of 4e-3 and 2e-3 s, rounded to whole steps per output, both ran with 2e-3.
  std::vector<StudyRun> runs = stepped({run_of(0.04, 2, 20), run_of(0.04, 2, 20), run_of(0.01, 4, 40),
                                        run_of(0, 0.5, 5, "stopped"), run_of(0.0025, 9, 90)});
  runs[0].dt = runs[1].dt;
  const StudyFindings findings = find_out(sample_steps(), runs, sample_column, std::nullopt);
  REQUIRE(findings.orders.size() == 1);
  REQUIRE(findings.orders[0].orders.size() == 1);
  CHECK(findings.orders[0].orders[0] == Approx(2));
  CHECK(findings.orders[0].fit == Approx(2));
  // What bounds an automatic step besides its safety makes two runs one, too.
  StudyPlan plan = sample_steps();
  plan.pointers[0] = "/time/safety";
  CHECK(find_out(plan, runs, sample_column, std::nullopt).orders[0].fit == Approx(2));
  runs[2].dt = runs[1].dt;
  CHECK(find_out(sample_steps(), runs, sample_column, std::nullopt).orders.empty());
}

TEST_CASE("What a reference does after the runs does not make their errors small", "[study]") {
  const std::vector<StudyRun> runs{run_of(0.16, 1, 10), run_of(0.04, 2, 20), run_of(0.01, 4, 40),
                                   run_of(0.08, 2, 2), run_of(0.02, 9, 90)};
  Series reference = run_of(0, 0, 0).history;
  const double error = *find_out(sample_steps(), runs, sample_column, reference).runs[0].error;
  reference.time.push_back(1e3);
  reference.values[0].push_back(1e6);
  CHECK(*find_out(sample_steps(), runs, sample_column, reference).runs[0].error == error);
}

TEST_CASE("Errors are shares of the line between the rows of a reference, where those are few", "[study]") {
  const std::vector<StudyRun> runs{run_of(0.16, 1, 10), run_of(0.04, 2, 20), run_of(0.01, 4, 40),
                                   run_of(0.08, 2, 2), run_of(0.02, 9, 90)};
  Series reference = run_of(0, 0, 0).history;
  reference.time = {-1, 1e3};
  reference.values = {{2, 2}};
  CHECK(*find_out(sample_steps(), runs, sample_column, reference).runs[0].error == Approx(0.08));
  reference.time = {1e3, 2e3};
  CHECK_THROWS_WITH(find_out(sample_steps(), runs, sample_column, reference),
                    Contains("no time in common with a run"));
}

TEST_CASE("What rounding makes tells no order", "[study]") {
  // Errors of 4e-13, 2e-13 and 1e-13 fall with the step, and yet are none of its.
  const std::vector<StudyRun> runs = stepped({run_of(8e-13, 1, 10), run_of(4e-13, 2, 20),
                                              run_of(2e-13, 4, 40), run_of(1e-13, 8, 80), run_of(0, 9, 90)});
  CHECK(find_out(sample_steps(), runs, sample_column, std::nullopt).orders.empty());
}

TEST_CASE("There is an order in what resolves, none in what a scene is", "[study]") {
  const std::vector<StudyRun> runs = stepped({run_of(0.16, 1, 10), run_of(0.04, 2, 20), run_of(0.01, 4, 40),
                                              run_of(0, 0.5, 5, "stopped"), run_of(0.0025, 9, 90)});
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
  for (double& value : reference.values[0]) value = 1e-15;
  CHECK_THROWS_WITH(find_out(sample_steps(), runs, sample_column, reference, 1e-12),
                    Contains("is rounding, 1e-15 at most, all along in the reference"));
  for (StudyRun& each : runs) each.end = "stopped";
  CHECK_THROWS_AS(find_out(sample_steps(), runs, sample_column, std::nullopt), NumericalTrouble);
  for (StudyRun& each : runs) each.end = "refused";
  CHECK_THROWS_AS(find_out(sample_steps(), runs, sample_column, std::nullopt), InputError);
}

TEST_CASE("A study tells of a curve that ends before its runs, and measures none by another that did",
          "[study]") {
  std::vector<StudyRun> runs{run_of(0.16, 1, 10), run_of(0.04, 2, 20), run_of(0.01, 4, 40),
                             run_of(0.08, 2, 2), run_of(0.02, 9, 90)};
  Series reference = run_of(0, 0, 0).history;
  reference.time.pop_back();
  reference.values[0].pop_back();
  CHECK_THAT(words_of_reference(sample_steps(), find_out(sample_steps(), runs, sample_column, reference)),
             Contains("the reference file, which goes from 0 to"));
  runs[0].history = reference;
  const StudyFindings findings = find_out(sample_steps(), runs, sample_column, std::nullopt);
  CHECK_FALSE(findings.runs[0].error);
  CHECK_THAT(findings.runs[0].why_none, Contains("it goes from 0 to") && Contains("the most work from 0 to"));
  CHECK(findings.runs[1].error);
  CHECK(findings.runs[1].why_none.empty());
}

TEST_CASE("A study says why a run has no error that a reference does not reach", "[study]") {
  std::vector<StudyRun> runs{run_of(0.16, 1, 10), run_of(0.04, 2, 20), run_of(0.01, 4, 40),
                             run_of(0.08, 2, 2), run_of(0.02, 9, 90)};
  Series reference = run_of(0, 0, 0).history;
  runs[0].history.time.resize(1);
  for (std::vector<double>& values : runs[0].history.values) values.resize(1);
  reference.time.erase(reference.time.begin());
  for (std::vector<double>& values : reference.values) values.erase(values.begin());
  const StudyFindings findings = find_out(sample_steps(), runs, sample_column, reference);
  CHECK_FALSE(findings.runs[0].error);
  CHECK(findings.runs[0].why_none == "it has no time in common with the reference");
  CHECK(findings.runs[1].why_none.empty());
}

TEST_CASE("A study says that no run has the column of its reference", "[study]") {
  std::vector<StudyRun> runs{run_of(0.16, 1, 10), run_of(0.04, 2, 20), run_of(0.01, 4, 40),
                             run_of(0.08, 2, 2), run_of(0.02, 9, 90)};
  const Series reference = run_of(0, 0, 0).history;
  for (StudyRun& run : runs) run.history.names = {"other.speed [m/s]"};
  CHECK_THROWS_WITH(find_out(sample_steps(), runs, sample_column, reference),
                    Contains("no run that finished has a column"));
  CHECK_THROWS_WITH(find_out(sample_steps(), runs, sample_column, std::nullopt),
                    Contains("the run with the most work has no column"));
}
