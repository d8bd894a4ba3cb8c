#include "output/records.hpp"

#include "files/input_error.hpp"
#include "files/whole_file.hpp"
#include "output/recorded_run.hpp"
#include "scratch.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace talus;
using Catch::Matchers::Contains;

TEST_CASE("the record of a run is read whole or not at all", "[output][records]") {
  const Scratch scratch;
  WorkingScene text;
  text.bodies = box("a", 0, 0, 1, 1, "");
  text.time = R"({"end": 0.01, "dt": 0.001})";
  Simulation simulation(text.read(), {});
  RunOrder order;
  order.folder = scratch.folder();
  record_run(simulation, order);
  const auto whole = read_run_record(scratch.folder());
  CHECK(whole["end"] == "finished");
  CHECK(run_record_in(scratch.folder()).has_value());
  CHECK_FALSE(holds_comparison(scratch.folder()));

  const auto is_refused = [&](const std::string& record, const std::string& words) {
    INFO(record);
    scratch.write("run.json", record);
    CHECK_THROWS_WITH(read_run_record(scratch.folder()),
                      Contains("run.json' is no record of a run: its " + words));
    CHECK_FALSE(run_record_in(scratch.folder()).has_value());
  };
  for (const char* key :
       {"end", "t [s]", "scene", "plugins", "settings", "blocks", "elements", "steps", "settle_steps", "cost",
        "dt [s]", "largest_penetration [m]", "largest_residual_share", "warnings"}) {
    auto lacking = whole;
    lacking.erase(key);
    is_refused(lacking.dump(), std::string("/") + key);
    for (const auto& other : {nlohmann::ordered_json(true), nlohmann::ordered_json{1, 2}}) {
      auto wrong = whole;
      wrong[key] = other;
      is_refused(wrong.dump(), std::string("/") + key);
    }
  }
  auto unknown = whole;
  unknown["end"] = "somehow";
  is_refused(unknown.dump(), "/end is not what talus writes");
  for (const char* damaged : {"", "[]", "{", "3"}) {
    scratch.write("run.json", damaged);
    CHECK_THROWS_WITH(read_run_record(scratch.folder()), Contains("is no whole JSON object"));
  }
  auto endless = whole;
  endless["dt [s]"] = nullptr;  // as JSON has what is no finite number
  scratch.write("run.json", endless.dump());
  CHECK(run_record_in(scratch.folder()).has_value());
}

TEST_CASE("the record of a comparison names its runs", "[output][records]") {
  const Scratch scratch;
  CHECK_THROWS_WITH(holds_comparison(scratch.folder()), Contains("holds neither run.json nor compare.json"));
  CHECK_FALSE(comparison_record_in(scratch.folder()).has_value());
  scratch.write("compare.json", R"({"varied": "/a", "runs": [{"value": "1", "folder": "1"}]})");
  CHECK(holds_comparison(scratch.folder()));
  CHECK(read_comparison_record(scratch.folder())["runs"].size() == 1);
  for (const char* damaged :
       {R"({"varied": "/a"})", R"({"varied": "/a", "runs": []})", R"({"varied": "/a", "runs": {}})",
        R"({"varied": "/a", "runs": [{"value": "1"}]})", R"({"varied": "/a", "runs": [1]})"}) {
    scratch.write("compare.json", damaged);
    CHECK_THROWS_WITH(read_comparison_record(scratch.folder()),
                      Contains("compare.json' is no record of a comparison: its /runs is"));
    CHECK_FALSE(comparison_record_in(scratch.folder()).has_value());
  }
}
