#include "study/sample_runs.hpp"
#include "study/study_charts.hpp"
#include "study/study_page.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using Catch::Matchers::Contains;

namespace {

std::size_t times_in(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// The three coarser steps, one that failed, and the reference.
std::vector<StudyRun> sample_runs() {
  return stepped({run_of(0.16, 1, 10), run_of(0.04, 2, 20), run_of(0.01, 4, 40), run_of(0, 0.5, 5, "stopped"),
                  run_of(0.0025, 9, 90)});
}

std::string page_of(const StudyPlan& plan, const std::vector<StudyRun>& runs) {
  return study_page("a < b", "talus study x.json --vary '/time/dt=a'", plan, runs,
                    find_out(plan, runs, sample_column, std::nullopt));
}

}  // namespace

TEST_CASE("The page of a study holds charts, orders, all runs and what failed", "[study]") {
  const std::vector<StudyRun> runs = sample_runs();
  const std::string page = page_of(sample_steps(), runs);
  CHECK_THAT(page, Contains("<title>a &lt; b</title>") && Contains("talus study x.json --vary") &&
                       Contains("color-scheme: light dark") && Contains("prefers-color-scheme: dark"));
  CHECK(times_in(page, "<svg ") == 4);  // error against cost and against the step, residual, overlap
  CHECK_THAT(page, Contains("Error of m.speed [m/s] against cost") &&
                       Contains("Error of m.speed [m/s] against /time/dt") && Contains("order 2.00") &&
                       Contains("Largest energy residual") && Contains("Largest overlap"));
  CHECK_THAT(page, Contains("<td>reference</td>") && Contains("it &lt;blew&gt; up") &&
                       Contains("1 of them failed") && Contains("<td class=\"words\">2.00 2.00 </td>"));
  CHECK_THAT(page, Contains("most work; misses about 0.12 % itself"));
  CHECK(times_in(page, "★ run") == 3);
  CHECK(times_in(page, "<tr>") == 1 + runs.size() + 2);  // heads, runs, orders
  // What failed stands below what finished, though it cost less.
  CHECK(page.find("stopped") > page.find("<td>reference</td>"));
}

TEST_CASE("The page of a study asks nothing of a network and runs nothing", "[study]") {
  const std::string page = page_of(sample_steps(), sample_runs());
  for (const char* outside : {"<script", "<link rel=\"stylesheet", "@import", "url(", "src=", "{{"}) {
    CAPTURE(outside);
    CHECK_THAT(page, !Contains(outside));
  }
}

TEST_CASE("Where no number varies, residual and overlap stand against cost", "[study]") {
  const StudyPlan laws = grid({{"/contact/model", {"overlap_area", "vertex_edge"}}});
  const std::vector<StudyRun> runs{run_of(0.16, 1, 10), run_of(0, 2, 20)};
  const StudyFindings findings = find_out(laws, runs, sample_column, std::nullopt);
  CHECK(order_charts(laws, runs, findings).empty());
  CHECK_THAT(residual_svg(laws, runs), Contains("CPU in the steps") && Contains("model=overlap_area"));
  CHECK_THAT(page_of(laws, runs), !Contains("Observed order") && Contains("all finished"));
}

TEST_CASE("Families differ in one number alone and hold what finished", "[study]") {
  const StudyPlan plan =
      grid({{"/contact/model", {"a", "b"}}, {"/time/dt", {"1e-3", "4e-3", "2e-3"}}, {"/x", {"[1, 2]"}}});
  std::vector<StudyRun> runs(6, run_of(0.1, 1, 1));
  runs[4].end = "stopped";
  const std::vector<StudyFamily> found = families(plan, runs);
  REQUIRE(found.size() == 2);
  CHECK(found[0].variation == 1);
  CHECK(found[0].runs == std::vector<std::size_t>{1, 2, 0});
  CHECK(found[1].runs == std::vector<std::size_t>{5, 3});
  CHECK(number_of(plan, 1, 4) == 4e-3);
}
