#include "apps/program.hpp"
#include "figures/runs.hpp"
#include "files/input_error.hpp"
#include "files/whole_file.hpp"
#include "output/scratch.hpp"
#include "verification/report.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <stdexcept>

using namespace talus;
using namespace talus::verification;
using Catch::Contains;

namespace {

const Bench& bench() {
  static const Bench here(figures::registry(), TALUS_SCENES);
  return here;
}

/// Cases that together take some seconds.
std::vector<const Case*> quick_cases() {
  return chosen_cases({"incline/laws_part",
                       "friction/stick",
                       "impact",
                       "statics/overhang",
                       "continuum/patch",
                       "continuum/turns",
                       "continuum/inertia",
                       "continuum/critical_step",
                       "mass",
                       "same_bits/origin",
                       "same_bits/absolute_coordinates",
                       "extremes/mass_ratio",
                       "extremes/size",
                       "extremes/slender",
                       "extremes/zero_gap",
                       "extremes/refused_shapes",
                       "extremes/rounded_overlaps",
                       "extremes/within_a_hole",
                       "extremes/saw_tooth",
                       "extremes/bounce_by_step",
                       "extremes/beyond_critical",
                       "extremes/initial_overlap",
                       "extremes/fast_thin_plates",
                       "metamorphic/boost",
                       "metamorphic/units",
                       "metamorphic/time_reversal",
                       "metamorphic/translation"});
}

constexpr Case right{"made_up", "right", "Two and two are four.", 1,
                     [](const Bench&, Rows& rows) { rows.near(Kind::analytic, "2 + 2", 4, 4, 1e-3, "m"); }};
constexpr Case wrong{"made_up", "wrong", "Two and two are five.", 9,
                     [](const Bench&, Rows& rows) { rows.near(Kind::analytic, "2 + 2", 4, 5, 1e-3, "m"); }};
constexpr Case broken{"made_up", "broken", "It ends.", 1,
                      [](const Bench&, Rows&) { throw std::runtime_error("it | fell"); }};

}  // namespace

TEST_CASE("Quick reference cases hold, and documents show what they give", "[verification][slow_sanitised]") {
  const std::string documents =
      read_whole_file(TALUS_DOCS "/verification.md") + read_whole_file(TALUS_DOCS "/stability.md");
  for (const CaseResult& result : verify(bench(), {.cases = quick_cases(), .threads = 2})) {
    const std::string table = markdown_table({result}, result.of->group);
    const std::string lines = table.substr(table.find('\n', table.find('\n') + 1) + 1);  // without the head
    INFO(text_of(result) << "\n" << lines);
    CHECK(result.held());
    CHECK(!result.rows.empty());
    CHECK_THAT(documents, Contains(lines));
  }
}

TEST_CASE("Documents name every case with what it predicts", "[verification]") {
  const std::string documents =
      read_whole_file(TALUS_DOCS "/verification.md") + read_whole_file(TALUS_DOCS "/stability.md");
  for (const Case* each : all_cases()) {
    INFO(each->full_name());
    CHECK_THAT(documents, Contains(fmt::format("| **`{}`** {} |", each->name, each->sentence)));
  }
}

TEST_CASE("A wrong reference is missed, and so is a case that ends before its end", "[verification]") {
  std::vector<std::string> told;
  const std::vector<CaseResult> results = verify(
      bench(), {.cases = {&right, &wrong, &broken}, .threads = 3, .finished = [&](const CaseResult& result) {
                  told.emplace_back(result.of->name);
                }});
  CHECK(told == std::vector<std::string>{"right", "wrong", "broken"});
  CHECK(results[0].held());
  CHECK_FALSE(results[1].held());
  CHECK_FALSE(results[2].held());
  CHECK_THAT(text_of(results[1]), Contains("MISSED  analytic") && Contains("2 + 2: 4 m (5 m ± 0.1 %)"));
  CHECK_THAT(text_of(results[2]), Contains("MISSED  ended before its end: it | fell"));
  CHECK(summary_of(results) == "1 held, 2 missed, 0 shown");
  CHECK_THAT(markdown_table(results, "made_up"),
             Contains("| **`wrong`** Two and two are five. | | | | | |\n"
                      "| – 2 + 2 | analytic | 5 m | 0.1 % | 4 m | MISSED |\n") &&
                 Contains("| – ended before its end | | | | it \\| fell | MISSED |\n"));
  const auto json = nlohmann::json::parse(json_of(results));
  CHECK(json["held"] == 1);
  CHECK(json["missed"] == 2);
  CHECK(json["cases"][1]["rows"][0]["value"] == 4);
  CHECK(json["cases"][1]["rows"][0]["held"] == false);
  CHECK(json["cases"][2]["trouble"] == "it | fell");
}

TEST_CASE("What is no number holds nothing", "[verification]") {
  Rows rows;
  const double none = std::numeric_limits<double>::quiet_NaN();
  rows.near(Kind::analytic, "a", none, 1, 1, "");
  rows.about(Kind::analytic, "b", none, 1, 1, "");
  rows.between(Kind::analytic, "c", none, 0, 1, "");
  rows.below(Kind::bound, "d", none, 1, "");
  rows.above(Kind::bound, "e", none, 1, "");
  for (const Row& row : rows.rows) {
    INFO(row.what);
    CHECK(row.held == false);
  }
}

TEST_CASE("An interrupted verification holds nothing that it did not reach", "[verification]") {
  const std::atomic<bool> interrupted = true;
  const std::vector<CaseResult> results = verify(bench(), {.cases = {&right}, .interrupted = &interrupted});
  CHECK_FALSE(results[0].done);
  CHECK_FALSE(results[0].held());
}

TEST_CASE("Tables of a document are written anew where all of a group was measured", "[verification]") {
  const std::vector<CaseResult> results =
      verify(bench(), {.cases = chosen_cases({"incline", "impact/unequal"}), .threads = 2});
  const std::string document =
      "# A\n<!-- verify: incline -->\nold\n<!-- end of verify -->\nwords\n<!-- verify: impact "
      "-->\nkept\n<!-- end of verify -->\n";
  const std::string due =
      "# A\n<!-- verify: incline -->\n" + markdown_table(results, "incline") +
      "<!-- end of verify -->\nwords\n<!-- verify: impact -->\nkept\n<!-- end of verify -->\n";
  CHECK(with_tables(document, results) == due);
  CHECK_THROWS_WITH(with_tables("<!-- verify: impakt -->\n<!-- end of verify -->\n", results),
                    Contains("no table \"impakt\"") && Contains("did you mean \"impact\"?"));
  CHECK_THROWS_WITH(with_tables("<!-- verify: incline -->\n", results), Contains("has no end"));
  CHECK_THROWS_WITH(with_tables("# nothing here\n", results), Contains("nothing to write"));
}

TEST_CASE("Patterns choose groups, cases and both; others get the nearest name", "[verification]") {
  const auto names = [](const std::vector<std::string>& patterns) {
    std::vector<std::string> chosen;
    for (const Case* each : chosen_cases(patterns)) chosen.push_back(each->full_name());
    return chosen;
  };
  CHECK(names({}).size() == all_cases().size());
  CHECK(names({"stick", "impact/order"}) == std::vector<std::string>{"friction/stick", "impact/order"});
  CHECK(names({"friction/stick*"}) == std::vector<std::string>{"friction/stick", "friction/stick_undamped"});
  CHECK(names({"*/overhang"}) == std::vector<std::string>{"statics/overhang"});
  CHECK_THROWS_WITH(names({"inclime"}), Contains("'inclime'") && Contains("did you mean \"incline\"?"));
  std::vector<std::string> all = names({});
  std::sort(all.begin(), all.end());
  CHECK(std::adjacent_find(all.begin(), all.end()) == all.end());
}

TEST_CASE("talus verify lists its cases, refuses unknown ones, and writes what it held as JSON",
          "[verification][apps]") {
  const Scratch scratch;
  const Call list = call_talus(scratch.folder(), {"verify", "--list", "impact"});
  CHECK(list.code == 0);
  CHECK_THAT(list.out, Contains("impact/collision") && Contains("mass on a spring") && !Contains("incline"));
  const Call unknown = call_talus(scratch.folder(), {"verify", "impakt"});
  CHECK(unknown.code == 2);
  CHECK_THAT(unknown.err, Contains("no case is called 'impakt'") && Contains("did you mean \"impact\"?"));
  CHECK(call_talus(scratch.folder(), {"verify", "impact/unequal"}).code == 2);  // no scenes here
  CHECK_THAT(call_talus(scratch.folder(), {"verify", "impact/unequal", "--scenes", "none"}).err,
             Contains("--scenes none: there is no such folder"));

  const Call held = call_talus(scratch.folder(),
                               {"verify", "impact/unequal", "--scenes", TALUS_SCENES, "--json", "rows.json"});
  INFO(held.out << held.err);
  CHECK(held.code == 0);
  CHECK_THAT(held.out, Contains("held    analytic") && Contains("2 held, 0 missed, 0 shown"));
  CHECK(json_of(scratch / "rows.json")["cases"][0]["rows"].size() == 2);

  // A block of another density is not three times as heavy.
  std::string scene = read_whole_file(TALUS_SCENES "/collision_unequal.json");
  const std::size_t velocity = scene.find("\"velocity\": [0.5, 0]");
  REQUIRE(velocity != std::string::npos);
  scene.replace(velocity, 20, "\"velocity\": [0.6, 0]");
  scratch.write("collision_unequal.json", scene);
  const Call missed =
      call_talus(scratch.folder(), {"verify", "impact/unequal", "--scenes", ".", "--markdown"});
  CHECK(missed.code == 1);
  CHECK_THAT(missed.out, Contains("## impact") && Contains("| MISSED |"));
}
