#include "apps/program.hpp"
#include "files/folder_lock.hpp"
#include "files/input_error.hpp"
#include "files/whole_file.hpp"
#include "output/scratch.hpp"
#include "plugin/simd_level.hpp"
#include "scene/read.hpp"
#include "study/study.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <signal.h>

#include <algorithm>
#include <array>

using namespace talus;
using Catch::Matchers::Contains;

TEST_CASE("A study runs every combination, lists what failed, and goes on where it was", "[apps][study]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const std::vector<std::string> words{"study",
                                       "small.json",
                                       "--quiet",
                                       "--vary",
                                       "/contact/model=overlap_area,vertex_edge",
                                       "--vary",
                                       "/time/dt=2e-4,1e-4,5e-5,1e-2,1e-300"};
  const Call call = call_talus(scratch.folder(), words);
  INFO(call.out + call.err);
  REQUIRE(call.code == 0);
  CHECK_THAT(call.out, Contains("order in /time/dt") && Contains("failed: model=overlap_area dt=1e-300") &&
                           Contains("failed: model=vertex_edge dt=1e-2"));
  const auto study = json_of(scratch / "out/small-study/study.json");
  REQUIRE(study["runs"].size() == 10);
  CHECK(study["reference"] == "run_0003");
  CHECK(study["runs"][0]["error [-]"].get<double>() > study["runs"][1]["error [-]"].get<double>());
  CHECK_THAT(read_whole_file(scratch / "out/small-study/study.csv"), Contains("run_0010"));
  CHECK_THAT(read_whole_file(scratch / "out/small-study/study.html"),
             Contains("talus study small.json") && Contains("run_0010") && Contains("refused"));

  // Of one run the folder is lost; the others are taken as they are.
  const auto kept = std::filesystem::last_write_time(scratch / "out/small-study/run_0001/run.json");
  std::filesystem::remove_all(scratch / "out/small-study/run_0002");
  const Call again = call_talus(scratch.folder(), words);
  REQUIRE(again.code == 0);
  CHECK(std::filesystem::last_write_time(scratch / "out/small-study/run_0001/run.json") == kept);
  CHECK(std::filesystem::exists(scratch / "out/small-study/run_0002/run.json"));
  CHECK(json_of(scratch / "out/small-study/study.json")["runs"][1]["rms"] == study["runs"][1]["rms"]);

  // A law that has changed since makes its runs anew.
  auto record = json_of(scratch / "out/small-study/run_0001/run.json");
  const std::string hash = record["plugins"][0]["xxh3_128"];
  record["plugins"][0]["xxh3_128"] = "another";
  scratch.write("out/small-study/run_0001/run.json", record.dump());
  REQUIRE(call_talus(scratch.folder(), words).code == 0);
  CHECK(json_of(scratch / "out/small-study/run_0001/run.json")["plugins"][0]["xxh3_128"] == hash);
}

TEST_CASE("A study passes on what its runs warn of", "[apps][study]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const Call call =
      call_talus(scratch.folder(), {"study", "small.json", "--quiet", "--vary", "/time/dt=2e-4,1e-4", "--set",
                                    R"(/settle={"duration": 1e-3, "damping": 10, "until": 1e-9})"});
  INFO(call.out + call.err);
  REQUIRE(call.code == 0);
  CHECK_THAT(call.out, Contains("warning: dt=2e-4: settling ended with its duration"));
  CHECK_THAT(json_of(scratch / "out/small-study/study.json")["runs"][0]["warnings"].dump(),
             Contains("settling ended with its duration"));
}

TEST_CASE("A study says why runs have no error", "[apps][study]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const Call call =
      call_talus(scratch.folder(), {"study", "small.json", "--quiet", "--vary", "/time/end=0.01,0.015,0.02"});
  INFO(call.out + call.err);
  REQUIRE(call.code == 0);
  CHECK_THAT(call.out + call.err,
             Contains("no error of end=0.01 and of 1 more: it goes from 0 to 0.01 s, and "
                      "the run with the most work from 0 to 0.02"));
}

TEST_CASE("A study makes each run as often as it is asked to and takes the median of the cost",
          "[apps][study]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const Call call = call_talus(scratch.folder(), {"study", "small.json", "--quiet", "--vary",
                                                  "/time/dt=2e-4,1e-4,-1", "--repeat", "3"});
  INFO(call.out + call.err);
  REQUIRE(call.code == 0);
  const auto study = json_of(scratch / "out/small-study/study.json");
  for (const std::size_t run : {0, 1}) {
    std::vector<double> each = study["runs"][run]["cpu of each [s]"];
    REQUIRE(each.size() == 3);
    std::sort(each.begin(), each.end());
    CHECK(study["runs"][run]["cpu [s]"] == each[1]);
  }
  CHECK(study["runs"][2]["end"] == "refused");
  CHECK(json_of(scratch / "out/small-study/run_0001_3/run.json")["state_hash"] ==
        json_of(scratch / "out/small-study/run_0001/run.json")["state_hash"]);
  CHECK(call_talus(scratch.folder(), {"study", "small.json", "--vary", "/time/dt=1e-4", "--repeat", "0"})
            .code == 2);
}

TEST_CASE("advise proposes a line of --set that keeps the error", "[apps][study]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const Call call = call_talus(scratch.folder(), {"advise", "small.json", "--error", "5%", "--quiet"});
  INFO(call.out + call.err);
  CHECK(call.code == 0);
  CHECK_THAT(call.out, Contains("for 5 % take --set /time/safety="));
  CHECK(call_talus(scratch.folder(), {"advise", "small.json", "--error", "1e-9%", "--quiet"}).code == 6);
  const Call quoted =
      call_talus(scratch.folder(), {"advise", "small.json", "--error", "50%", "--quiet", "--vary",
                                    "/time/dt=2e-4,1e-4", "--vary", R"(/title="a b")", "--out", "q"});
  INFO(quoted.out + quoted.err);
  CHECK_THAT(quoted.out, Contains(R"( --set '/title="a b"')"));
  const Call equals = call_talus(
      scratch.folder(), {"advise", "small.json", "--error", "50%", "--quiet", "--overwrite", "--vary",
                         "/interfaces/0/friction_angle=10,20", "--set", "/time/dt=1e-4"});
  CHECK_THAT(equals.err, Contains("first of several that did the most work"));
  const Call alike = call_talus(scratch.folder(), {"advise", "small.json", "--error", "5%", "--quiet",
                                                   "--vary", "/title=a,b", "--out", "alike"});
  CHECK(alike.code == 0);
  CHECK_THAT(alike.out, Contains("nothing to choose: all runs are the same") && !Contains("take --set"));
  CHECK(call_talus(scratch.folder(), {"advise", "small.json"}).code == 2);
  CHECK(call_talus(scratch.folder(), {"advise", "small.json", "--error", "x"}).code == 2);
}

TEST_CASE("A study does not go on with a table that was changed while it ran", "[apps][study]") {
  const Scratch scratch;
  const std::filesystem::path table = scratch.write("a.csv", "0,1\n60,1\n");
  StudyOrder order;
  order.folder = scratch / "study";
  order.plan = grid({parse_variation("/time/dt=2e-4,1e-4")});
  int read = 0;
  order.read = [&](const std::vector<Override>& overrides) {
    if (++read == 2) scratch.write("a.csv", "0,2\n60,2\n");
    HeldScene held{std::make_unique<Registry>(), {}};
    load_folders(*held.registry, std::array{std::filesystem::path(TALUS_PLUGINS)});
    std::vector<Override> all = overrides;
    all.push_back({"/base_acceleration", R"([{"time": ")" + table.string() + R"("}, 0])"});
    held.scene = read_scene_text(small_scene(), "small.json", *held.registry, {all, false});
    return held;
  };
  try {
    make_runs(order);
    FAIL("went on");
  } catch (const InputError& error) {
    CHECK_THAT(error.what(), Contains("a.csv' changed while the study ran"));
  }
}

TEST_CASE("A study refuses what it cannot measure", "[apps][study]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  CHECK(call_talus(scratch.folder(), {"study", "small.json"}).code == 2);
  const Call call = call_talus(
      scratch.folder(), {"study", "small.json", "--vary", "/time/dt=1e-4", "--metric", "nobody.speed"});
  CHECK(call.code == 2);
  CHECK_THAT(call.err, Contains("block.speed [m/s]"));
  CHECK(call_talus(scratch.folder(), {"study", "missing.json", "--vary", "/time/dt=1e-4"}).code == 5);
  CHECK_THAT(call_talus(scratch.folder(),
                        {"study", "small.json", "--vary", "/time/dt=1e-4", "--vary", "/time/dt=2e-4"})
                 .err,
             Contains("is given twice"));
  const std::vector<std::string> words{"study", "small.json", "--vary", "/time/dt=1e-4", "--out", "other"};
  std::filesystem::create_directory(scratch / "other");
  {
    const FolderLock theirs(scratch / "other");
    CHECK_THAT(call_talus(scratch.folder(), words).err, Contains("another talus"));
  }
  REQUIRE(call_talus(scratch.folder(), words).code == 0);
  std::vector<std::string> others = words;
  others[3] = "/time/dt=2e-4";
  const Call refused = call_talus(scratch.folder(), others);
  CHECK(refused.code == 2);
  CHECK_THAT(refused.err, Contains("run_0001' holds a run with other values"));
  std::string history = read_whole_file(scratch / "other/run_0001/history.csv");
  write_whole_file(scratch / "other/run_0001/history.csv", history.substr(0, history.size() / 2));
  REQUIRE(call_talus(scratch.folder(), words).code == 0);
  CHECK(read_whole_file(scratch / "other/run_0001/history.csv") == history);
  others.emplace_back("--overwrite");
  CHECK(call_talus(scratch.folder(), others).code == 0);
  // Other instructions give the same bits at another cost.
  std::vector<std::string> scalar = words;
  scalar[3] = "/time/dt=2e-4";
  scalar.insert(scalar.end(), {"--simd", "scalar"});
  if (best_simd_level() != SimdLevel::scalar)
    CHECK_THAT(call_talus(scratch.folder(), scalar).err, Contains("with other instructions"));
  scratch.write("other/run.json", "{}");
  CHECK_THAT(call_talus(scratch.folder(), words).err, Contains("results of a single run ('run.json')"));
}

TEST_CASE("A study replaces neither its scene nor its reference", "[apps][study]") {
  const Scratch scratch;
  std::filesystem::create_directory(scratch / "mine");
  scratch.write("mine/study.json", small_scene());
  scratch.write("small.json", small_scene());
  const std::string reference = "t [s],block.speed [m/s]\n0,0\n10,1\n";
  scratch.write("mine/study.csv", reference);
  const Call scene =
      call_talus(scratch.folder(), {"study", "mine/study.json", "--vary", "/time/dt=1e-4", "--out", "mine"});
  CHECK(scene.code == 2);
  CHECK_THAT(scene.err, Contains("is read to make the results that would replace it"));
  CHECK(read_whole_file(scratch / "mine/study.json") == small_scene());
  const Call curve =
      call_talus(scratch.folder(), {"study", "small.json", "--vary", "/time/dt=1e-4", "--metric",
                                    "block.speed", "--reference", "mine/study.csv", "--out", "mine"});
  CHECK(curve.code == 2);
  CHECK_THAT(curve.err, Contains("is read to make the results that would replace it"));
  CHECK(read_whole_file(scratch / "mine/study.csv") == reference);
}

TEST_CASE("A study that replaces another leaves nothing of it, and a run that it shares", "[apps][study]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const auto study = [&](const std::string& steps, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"study", "small.json", "--quiet",          "--out",
                                   "s",     "--vary",     "/time/dt=" + steps};
    words.insert(words.end(), more.begin(), more.end());
    return call_talus(scratch.folder(), words);
  };
  const auto is_there = [&](const std::string& name) {
    return std::filesystem::exists(scratch / ("s/" + name));
  };
  REQUIRE(study("2e-4,1e-4,5e-5", {"--repeat", "2"}).code == 0);
  scratch.write("s/run_0003/notes.txt", "mine");
  const auto kept = std::filesystem::last_write_time(scratch / "s/run_0001/run.json");

  // Where none of its scenes can run it replaces nothing.
  const Call none = study("-1,-2", {"--overwrite"});
  CHECK(none.code == 2);
  CHECK(is_there("study.csv"));
  CHECK(is_there("run_0002/run.json"));
  const Call read = study("2e-4", {"--overwrite", "--reference", "s/run_0003/history.csv"});
  CHECK(read.code == 2);
  CHECK_THAT(read.err, Contains("is read to make the results that would replace it"));
  CHECK(is_there("study.csv"));
  CHECK(is_there("run_0002/run.json"));

  const Call call = study("2e-4,-1", {"--overwrite"});
  INFO(call.out + call.err);
  REQUIRE(call.code == 0);
  CHECK(std::filesystem::last_write_time(scratch / "s/run_0001/run.json") == kept);
  CHECK_FALSE(is_there("run_0001_2"));
  CHECK_FALSE(is_there("run_0002"));
  CHECK_FALSE(is_there("run_0003/run.json"));
  CHECK(read_whole_file(scratch / "s/run_0003/notes.txt") == "mine");
  CHECK(json_of(scratch / "s/study.json")["runs"].size() == 2);

  // Broken off, it has no tables of the one before.
  const Call broken =
      call_and_signal(scratch.folder(),
                      {"study", "small.json", "--quiet", "--out", "s", "--vary", "/time/end=1e5,2e5",
                       "--threads", "2", "--set", "/output/history=0.1", "--overwrite"},
                      SIGINT, scratch / "s/run_0002/frames.pvd");
  CHECK(broken.code == 130);
  for (const char* table : {"study.csv", "study.json", "study.svg", "study.html"})
    CHECK_FALSE(is_there(table));
}

TEST_CASE("A run of a study whose record is damaged is made again", "[apps][study]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const std::vector<std::string> words{"study", "small.json", "--quiet",           "--out",
                                       "s",     "--vary",     "/time/dt=2e-4,1e-4"};
  REQUIRE(call_talus(scratch.folder(), words).code == 0);
  const auto whole = json_of(scratch / "s/run_0001/run.json");
  const auto is_made_again = [&](const nlohmann::json& damaged) {
    scratch.write("s/run_0001/run.json", damaged.dump());
    const Call call = call_talus(scratch.folder(), words);
    INFO(damaged.dump() + call.err);
    CHECK(call.code == 0);
    CHECK(json_of(scratch / "s/run_0001/run.json")["state_hash"] == whole["state_hash"]);
    CHECK(json_of(scratch / "s/run_0001/run.json").contains("cost"));
  };
  for (const char* key : {"cost", "end", "dt [s]"}) {
    auto lacking = whole;
    lacking.erase(key);
    is_made_again(lacking);
  }
  auto wrong = whole;
  wrong["plugins"] = {1, 2};
  is_made_again(wrong);
}
