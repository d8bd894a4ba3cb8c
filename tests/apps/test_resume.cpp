#include "apps/program.hpp"
#include "files/hash.hpp"
#include "files/whole_file.hpp"
#include "output/scratch.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <signal.h>
#include <sys/stat.h>

#include <fstream>
#include <map>
#include <random>
#include <thread>

using namespace talus;
using Catch::Matchers::Contains;

namespace {

/// Some tenths of a second of steps, with rows and frames.
std::vector<std::string> run_words(const std::string& out, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words{
      "run",   "small.json",           "--quiet", "--out",           out, "--set", "/time/end=60",
      "--set", "/output/history=0.25", "--set",   "/output/frames=5"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// Rows, frames and their list, and the state at the end.
void check_same_results(const Scratch& scratch, const std::string& got, const std::string& due) {
  const auto text = [&](const std::string& folder, const std::string& file) {
    return read_whole_file(scratch / folder / file);
  };
  CHECK(text(got, "history.csv") == text(due, "history.csv"));
  CHECK(text(got, "frames.pvd") == text(due, "frames.pvd"));
  for (const auto& entry : std::filesystem::directory_iterator(scratch / due / "frames")) {
    const std::string file = "frames/" + entry.path().filename().string();
    CHECK(text(got, file) == text(due, file));
  }
  const auto got_record = json_of(scratch / got / "run.json"),
             due_record = json_of(scratch / due / "run.json");
  for (const char* key :
       {"end", "t [s]", "steps", "ledger", "state_hash", "largest_residual_share", "warnings"})
    CHECK(got_record[key] == due_record[key]);
}

}  // namespace

TEST_CASE("resume goes on with what Ctrl-C broke off, and results are those of one run", "[apps][resume]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  REQUIRE(call_talus(scratch.folder(), run_words("whole")).code == 0);
  Call call = call_and_signal(scratch.folder(), run_words("broken"), SIGINT, scratch / "broken/frames.pvd");
  REQUIRE(call.code == 130);
  CHECK_THAT(call.err, Contains("`talus resume broken` goes on"));
  // Broken off once more, before the first instant of it.
  call = call_talus(scratch.folder(), {"resume", "broken", "--wall-time", "0"});
  CHECK(call.code == 130);
  CHECK_THAT(call.err, Contains("out of wall time"));
  call = call_talus(scratch.folder(), {"info", "broken"});
  CHECK(call.code == 0);
  CHECK_THAT(call.out, Contains("a whole checkpoint") && Contains("the wall time was over") &&
                           Contains("small.json") && Contains("/time/end=60") &&
                           Contains("liboverlap_area.so"));
  call = call_talus(scratch.folder(), {"resume", "broken", "--quiet"});
  INFO(call.err);
  REQUIRE(call.code == 0);
  check_same_results(scratch, "broken", "whole");
  CHECK(json_of(scratch / "broken/run.json")["continued [s]"].size() == 2);
  CHECK_FALSE(std::filesystem::exists(scratch / "broken/checkpoint.talus"));
  call = call_talus(scratch.folder(), {"resume", "broken"});
  CHECK(call.code == 2);
  CHECK_THAT(call.err, Contains("the run in 'broken' is at its end"));
  call = call_talus(scratch.folder(), {"info", "broken"});
  CHECK(call.code == 2);
  CHECK_THAT(call.err, Contains("the run in 'broken' is at its end"));
}

TEST_CASE("a run that is resumed tells the hash of its scene, whatever letters its comments are of",
          "[apps][resume]") {
  const Scratch scratch;
  std::string text = small_scene();
  text.insert(text.find("a block falls"),
              "f\xfcr B\xf6"
              "den ");
  scratch.write("small.json", text);
  std::vector<std::string> words = run_words("broken");
  words.insert(words.end(), {"--wall-time", "0", "--set", "/time/end=0.1"});
  REQUIRE(call_talus(scratch.folder(), words).code == 130);
  REQUIRE(call_talus(scratch.folder(), {"resume", "broken", "--quiet"}).code == 0);
  CHECK(json_of(scratch / "broken/run.json")["scene"]["xxh3_128"] == hash_of_bytes(text));
}

TEST_CASE("kill -9 at any moment leaves a checkpoint that goes on to the same bits", "[apps][resume]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  REQUIRE(call_talus(scratch.folder(), run_words("whole")).code == 0);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> seconds(0.01, 0.06);
  const std::vector<std::string> often{"--checkpoint-every", "0"};
  int killed = 0;
  bool begun = false;
  while (killed < 50) {
    std::vector<std::string> words = run_words("broken", often);
    if (begun) words = {"resume", "broken", "--quiet", "--checkpoint-every", "0"};
    const Call call = call_and_signal_after(scratch.folder(), words, SIGKILL, seconds(random));
    INFO(call.err);
    if (call.code == 0) {  // it got to the end
      check_same_results(scratch, "broken", "whole");
      std::filesystem::remove_all(scratch / "broken");
      begun = false;
      continue;
    }
    REQUIRE(call.code == 128 + SIGKILL);
    ++killed;
    begun = std::filesystem::exists(scratch / "broken/checkpoint.talus");
    if (!begun) std::filesystem::remove_all(scratch / "broken");
  }
  if (!begun) return;
  REQUIRE(call_talus(scratch.folder(), {"resume", "broken", "--quiet"}).code == 0);
  check_same_results(scratch, "broken", "whole");
}

TEST_CASE("a run that is stopped keeps its last good state", "[apps][resume]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const Call call = call_talus(scratch.folder(), {"run", "small.json", "--set", "/time/dt=0.1", "--set",
                                                  "/output/history=0.1", "--set", "/time/end=20"});
  REQUIRE(call.code == 4);
  CHECK_THAT(call.err, Contains("the last good state was kept: out/small/checkpoint.talus"));
  const double stopped = json_of(scratch / "out/small/run.json")["t [s]"];
  const Call info = call_talus(scratch.folder(), {"info", "out/small"});
  CHECK_THAT(info.out, Contains("written because the last good state; then "));
  // It stops at the same place again.
  const Call again = call_talus(scratch.folder(), {"resume", "out/small"});
  CHECK(again.code == 4);
  CHECK(json_of(scratch / "out/small/run.json")["t [s]"] == stopped);
}

TEST_CASE("a state that nobody has judged yet does not replace the last good one", "[apps][resume]") {
  const Scratch scratch;
  const std::vector<std::string> too_long{"run",     TALUS_SCENES "/column.json",
                                          "--quiet", "--out",
                                          "out",     "--overwrite",
                                          "--set",   "/time/dt=1.6e-4"};
  const auto kept = [&](std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    const Call call = call_talus(scratch.folder(), words);
    CHECK(call.code == 4);
    const std::string from = "holds the state at t = ";
    const std::size_t at = call.err.find(from);
    REQUIRE(at != std::string::npos);
    return call.err.substr(at, call.err.find(" s", at + from.size()) - at);
  };
  CHECK(kept(too_long, {"--checkpoint-every", "0"}) == kept(too_long, {}));
}

TEST_CASE("the state kept when a resumed run is stopped knows all its resumes", "[apps][resume]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const std::vector<std::string> unstable{"run",   TALUS_SCENES "/column.json", "--quiet",     "--out", "out",
                                          "--set", "/time/dt=1.6e-4",           "--wall-time", "0"};
  REQUIRE(call_talus(scratch.folder(), unstable).code == 130);
  REQUIRE(call_talus(scratch.folder(), {"resume", "out", "--wall-time", "0"}).code == 130);
  REQUIRE(call_talus(scratch.folder(), {"resume", "out"}).code == 4);
  const std::string info = call_talus(scratch.folder(), {"info", "out"}).out;
  const auto continued = json_of(scratch / "out/run.json")["continued [s]"];
  REQUIRE(continued.size() == 2);
  std::size_t told = 0;
  for (std::size_t at = info.find("continued at"); at != std::string::npos;
       at = info.find("continued at", at + 1))
    ++told;
  INFO(info);
  CHECK(told == 2);
}

TEST_CASE("resume spoils no results of another run", "[apps][resume]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  REQUIRE(call_talus(scratch.folder(), run_words("broken", {"--wall-time", "0"})).code == 130);
  REQUIRE(
      call_talus(scratch.folder(), {"run", "small.json", "--quiet", "--out", "other", "--set",
                                    R"(/monitors=[{"name": "m", "body": "block", "quantities": ["ux"]}])"})
          .code == 0);
  const auto held = [&](const std::string& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(scratch / folder)) {
      if (entry.is_regular_file()) files[entry.path().string()] = read_whole_file(entry.path());
    }
    return files;
  };
  const auto refused = [&](const std::string& folder) {
    std::filesystem::copy_file(scratch / "broken/checkpoint.talus", scratch / folder / "checkpoint.talus");
    const auto before = held(folder);
    const Call call = call_talus(scratch.folder(), {"resume", folder + "/checkpoint.talus"});
    CHECK(call.code == 2);
    CHECK(held(folder) == before);
    return call.err;
  };
  CHECK_THAT(refused("other"), Contains("run.json' is of a run that finished"));
  std::filesystem::remove(scratch / "other/checkpoint.talus");
  std::filesystem::remove(scratch / "other/run.json");
  CHECK_THAT(refused("other"), Contains("history.csv' is not what the run left"));
  std::filesystem::create_directory(scratch / "empty");
  CHECK_THAT(refused("empty"), Contains("history.csv', which the run left, is gone"));
  std::filesystem::copy(scratch / "broken", scratch / "half");
  std::filesystem::remove(scratch / "half/checkpoint.talus");
  std::filesystem::remove(scratch / "half/energy.csv");
  CHECK_THAT(refused("half"), Contains("energy.csv', which the run left, is gone"));
}

TEST_CASE("resume refuses rows that were written anew, and leaves them as they are", "[apps][resume]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  REQUIRE(
      call_and_signal(scratch.folder(), run_words("broken"), SIGINT, scratch / "broken/frames.pvd").code ==
      130);
  for (const char* name : {"broken/history.csv", "broken/energy.csv"}) {
    CAPTURE(name);
    const std::string left = read_whole_file(scratch / name);
    // As a table read and written by another program has it.
    std::string anew = left;
    anew.replace(anew.find("\n0,"), 3, "\n0.0,");
    scratch.write(name, anew);
    const Call call = call_talus(scratch.folder(), {"resume", "broken", "--quiet"});
    CHECK(call.code == 2);
    CHECK_THAT(call.err, Contains(std::string(name) + "' is not what the run left: its first ") &&
                             Contains("nothing was written"));
    CHECK(read_whole_file(scratch / name) == anew);
    scratch.write(name, left + "0.125,");  // a row that was cut short is behind the checkpoint
  }
  REQUIRE(call_talus(scratch.folder(), {"resume", "broken", "--quiet"}).code == 0);
  REQUIRE(call_talus(scratch.folder(), run_words("whole")).code == 0);
  check_same_results(scratch, "broken", "whole");
}

TEST_CASE("a scene from a pipe runs, and leaves no state that nobody can go on from", "[apps][run]") {
  const Scratch scratch;
  const std::filesystem::path pipe = scratch / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  const auto run = [&](const std::vector<std::string>& more) {
    std::thread writer([&] { std::ofstream(pipe) << small_scene(); });
    std::vector<std::string> words{"run", "pipe", "--quiet", "--out", "out", "--overwrite"};
    words.insert(words.end(), more.begin(), more.end());
    const Call call = call_talus(scratch.folder(), words);
    writer.join();
    return call;
  };
  CHECK(run({}).code == 0);
  CHECK(json_of(scratch / "out/run.json")["scene"]["xxh3_128"] == hash_of_bytes(small_scene()));
  const Call call = run({"--wall-time", "0"});
  CHECK(call.code == 2);
  CHECK_THAT(call.err, Contains("leaves no checkpoint: write the scene to a file"));
}

TEST_CASE("every command reads its scene once, and so from a pipe", "[apps]") {
  const Scratch scratch;
  const std::filesystem::path pipe = scratch / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"validate", "pipe"},
        {"blocks", "pipe"},
        {"view", "pipe", "-o", "scene.svg"},
        {"compare", "pipe", "--vary", "/time/dt=1e-4,2e-4", "--quiet"},
        {"study", "pipe", "--vary", "/time/dt=1e-4,2e-4", "--quiet"}}) {
    INFO(words[0]);
    std::thread writer([&] { std::ofstream(pipe) << small_scene(); });
    const Call call = call_talus(scratch.folder(), words);
    writer.join();
    INFO(call.err);
    CHECK(call.code == 0);
  }
}

TEST_CASE("doctor says which step was the first bad one and what to change", "[apps][doctor]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  REQUIRE(call_talus(scratch.folder(), {"run", "small.json", "--set", "/time/dt=0.01", "--set",
                                        "/output/history=0.01", "--set", "/time/end=20", "--no-report"})
              .code == 4);
  const Call call = call_talus(scratch.folder(), {"doctor", "out/small"});
  INFO(call.out + call.err);
  CHECK(call.code == 0);
  CHECK_THAT(call.out, Contains("stopped at t = ") && Contains("again from the last good state") &&
                           Contains("first bad step (->): t = ") && Contains("/time/dt is ") &&
                           Contains("take \"auto\""));
  CHECK_FALSE(std::filesystem::exists(scratch / "out/small/report.html"));
  // Where rows are far apart the step that stops it is in none of them.
  REQUIRE(call_talus(scratch.folder(),
                     {"run", "small.json", "--set", "/time/dt=0.1", "--set", "/output/history=0.5", "--set",
                      "/output/frames=0.5", "--set", "/time/end=20", "--no-report", "--out", "sparse"})
              .code == 4);
  CHECK_THAT(call_talus(scratch.folder(), {"doctor", "sparse"}).out,
             Contains("% of the throughput at most, when the run was stopped"));
  REQUIRE(call_talus(scratch.folder(), {"run", "small.json", "--out", "good", "--quiet"}).code == 0);
  const Call good = call_talus(scratch.folder(), {"doctor", "good"});
  CHECK(good.code == 0);
  CHECK_THAT(good.out, Contains("finished at t = ") && Contains("the energy balance misses"));
  CHECK(call_talus(scratch.folder(), {"doctor", "nowhere"}).code == 5);
  const Call of_file = call_talus(scratch.folder(), {"doctor", "good/run.json"});
  CHECK(of_file.code == 2);
  CHECK_THAT(of_file.err, Contains("'good/run.json' is no folder of results"));
  for (const char* record : {"{\"end\": \"stopped\"}", "{\"end\": 3}", "[", "[]"}) {
    CAPTURE(record);
    scratch.write("good/run.json", record);
    const Call none = call_talus(scratch.folder(), {"doctor", "good"});
    CHECK(none.code == 2);
    CHECK_THAT(none.err, Contains("'good/run.json' is no record of a run"));
    const Call report = call_talus(scratch.folder(), {"report", "good"});
    CHECK(report.code == 2);
  }
}

TEST_CASE("doctor says why there is no state to go on from", "[apps][doctor]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  REQUIRE(call_talus(scratch.folder(),
                     {"compare", "small.json", "--vary", "/title=a,b", "--quiet", "--out", "c", "--set",
                      "/time/dt=0.01", "--set", "/output/history=0.01", "--set", "/time/end=20"})
              .code == 4);
  const Call compared = call_talus(scratch.folder(), {"doctor", "c/a"});
  CHECK(compared.code == 0);
  CHECK_THAT(compared.out,
             Contains("`compare`, `study` and scenes from a pipe keep none") && !Contains("before t = 0"));
  auto record = json_of(scratch / "c/a/run.json");
  record["settling_t [s]"] = 0.1;
  scratch.write("c/a/run.json", record.dump());
  CHECK_THAT(call_talus(scratch.folder(), {"doctor", "c/a"}).out, Contains("it was stopped before t = 0"));
}

TEST_CASE("resume goes on with the scene of then, and tells where its file has changed", "[apps][resume]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  REQUIRE(call_talus(scratch.folder(), run_words("broken", {"--wall-time", "0"})).code == 130);
  CHECK_THAT(call_talus(scratch.folder(), {"resume", "broken", "--wall-time", "0"}).err,
             !Contains("has changed"));
  scratch.write("small.json", small_scene() + "\n// later\n");
  CHECK_THAT(
      call_talus(scratch.folder(), {"resume", "broken", "--wall-time", "0"}).err,
      Contains("small.json' has changed since the run was started: it goes on with the scene of then"));
}

TEST_CASE("doctor leads from a run without a record to its checkpoint", "[apps][doctor]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  REQUIRE(call_talus(scratch.folder(), run_words("br oken", {"--wall-time", "0"})).code == 130);
  std::filesystem::remove(scratch / "br oken/run.json");
  const Call call = call_talus(scratch.folder(), {"doctor", "br oken"});
  CHECK(call.code == 2);
  CHECK_THAT(call.err, Contains("`talus resume 'br oken'` goes on"));
}

TEST_CASE("resume refuses what would not go on to the same bits", "[apps][resume]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  REQUIRE(call_talus(scratch.folder(), run_words("broken", {"--wall-time", "0"})).code == 130);
  Call call = call_talus(scratch.folder(), {"resume", "nowhere"});
  CHECK(call.code == 5);
  call = call_talus(scratch.folder(), {"resume", "small.json"});
  CHECK(call.code == 2);
  CHECK_THAT(call.err, Contains("'small.json' is no checkpoint of talus"));
  std::string text = read_whole_file(scratch / "broken/checkpoint.talus");
  write_whole_file(scratch / "broken/checkpoint.talus", text.substr(0, text.size() / 2));
  call = call_talus(scratch.folder(), {"resume", "broken"});
  CHECK(call.code == 2);
  CHECK_THAT(call.err, Contains("is damaged"));
  write_whole_file(scratch / "broken/checkpoint.talus", text);
  std::filesystem::remove(scratch / "broken/history.csv");
  call = call_talus(scratch.folder(), {"resume", "broken"});
  CHECK(call.code == 2);
  CHECK_THAT(call.err, Contains("history.csv', which the run left, is gone"));
  CHECK(call_talus(scratch.folder(), {"resume", "broken", "--wall-time", "-1"}).code == 2);
}

TEST_CASE("resume and study see that a file which the scene reads has changed", "[apps][resume][study]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  scratch.write("shake.csv", "0,1\n60,1\n");
  const std::vector<std::string> shaken{"--set", R"(/base_acceleration=[{"time": "shake.csv"}, 0])"};
  std::vector<std::string> words = run_words("broken", shaken);
  words.insert(words.end(), {"--wall-time", "0"});
  REQUIRE(call_talus(scratch.folder(), words).code == 130);
  const std::vector<std::string> study{"study",   "small.json", "--quiet", "--vary", "/time/dt=2e-4,1e-4",
                                       shaken[0], shaken[1]};
  REQUIRE(call_talus(scratch.folder(), study).code == 0);
  const std::filesystem::path first = scratch / "out/small-study/run_0001/run.json";
  const auto hash_before = json_of(first)["state_hash"];
  CHECK(json_of(first)["scene"]["files"].size() == 1);

  scratch.write("shake.csv", "0,-1\n60,-1\n");
  const Call resumed = call_talus(scratch.folder(), {"resume", "broken"});
  CHECK(resumed.code == 2);
  CHECK_THAT(resumed.err, Contains("shake.csv' changed"));
  REQUIRE(call_talus(scratch.folder(), study).code == 0);
  CHECK(json_of(first)["state_hash"] != hash_before);

  write_whole_file(first, R"({"talus": "0.1.0", "scene": {}})");
  CHECK(call_talus(scratch.folder(), study).code == 0);
}

TEST_CASE("resume and doctor load libraries that the scene names when they are allowed to, not before",
          "[apps][resume]") {
  const Scratch scratch;
  std::string text = small_scene();
  text.insert(text.find("\"title\""),
              "\"plugins\": [\"" TALUS_TEST_LIBRARIES "/conformance/libfavours_an_axis.so\"], ");
  scratch.write("small.json", text);
  const Call broken =
      call_talus(scratch.folder(), run_words("broken", {"--wall-time", "0", "--allow-plugins"}));
  INFO(broken.err);
  REQUIRE(broken.code == 130);
  CHECK_THAT(broken.err, Contains("`talus resume --allow-plugins broken` goes on"));
  const Call refused = call_talus(scratch.folder(), {"resume", "broken"});
  CHECK(refused.code == 3);
  CHECK_THAT(refused.err, Contains("--allow-plugins"));
  CHECK(call_talus(scratch.folder(), {"resume", "broken", "--allow-plugins", "--wall-time", "0"}).code ==
        130);

  std::vector<std::string> stopped = run_words("stopped", {"--allow-plugins", "--set", "/time/dt=0.1"});
  REQUIRE(call_talus(scratch.folder(), stopped).code == 4);
  CHECK(call_talus(scratch.folder(), {"doctor", "stopped"}).code == 3);
  CHECK(call_talus(scratch.folder(), {"doctor", "stopped", "--allow-plugins"}).code == 0);
}

TEST_CASE("resume looks into no folder of plugins that only its checkpoint names", "[apps][resume]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  std::filesystem::create_directory(scratch / "mine");
  const Call broken =
      call_talus(scratch.folder(), run_words("broken", {"--wall-time", "0", "--plugin-path", "mine"}));
  REQUIRE(broken.code == 130);
  CHECK_THAT(broken.err, Contains("`talus resume --allow-plugins broken` goes on"));
  const std::vector<std::string> words{"resume", "broken", "--wall-time", "0"};
  const Call refused = call_talus(scratch.folder(), words);
  CHECK(refused.code == 3);
  CHECK_THAT(refused.err, Contains("mine") && Contains("--plugin-path"));
  for (const std::vector<std::string>& leave :
       {std::vector<std::string>{"--allow-plugins"}, {"--plugin-path", "mine"}}) {
    std::vector<std::string> allowed = words;
    allowed.insert(allowed.end(), leave.begin(), leave.end());
    CHECK(call_talus(scratch.folder(), allowed).code == 130);
  }
}

TEST_CASE("The words that go on with a run can be given to a shell as they are", "[apps][resume]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const Call spaced = call_talus(scratch.folder(), run_words("my out", {"--wall-time", "0"}));
  CHECK_THAT(spaced.err, Contains("`talus resume 'my out'` goes on"));
  const Call dashed = call_talus(scratch.folder(), {"run", "small.json", "--wall-time", "0", "--out=-y"});
  CHECK_THAT(dashed.err, Contains("`talus resume ./-y` goes on"));
}
