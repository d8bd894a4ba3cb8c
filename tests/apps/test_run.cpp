#include "files/hash.hpp"
#include "files/whole_file.hpp"
#include "output/scratch.hpp"
#include "output/series.hpp"
#include "program.hpp"

#include <fmt/format.h>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <csignal>
#include <sstream>

using namespace talus;
using Catch::Matchers::Contains;

namespace {

int count_of(const std::string& text, const std::string& words) {
  int count = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++count;
  return count;
}

}  // namespace

TEST_CASE("a run tells when a library was refused and another brings what it needs", "[apps][run]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  std::filesystem::create_directory(scratch / "mine");
  std::filesystem::copy_file(TALUS_TEST_LIBRARIES "/libwrong_abi.so", scratch / "mine/liboverlap_area.so");
  std::filesystem::copy_file(TALUS_TEST_LIBRARIES "/libwrong_abi.so", scratch / "mine/libother.so");
  const Call call = call_talus(scratch.folder(), {"run", "small.json", "--plugin-path", "mine"});
  CHECK(call.code == 0);
  CHECK_THAT(call.err, Contains("mine/liboverlap_area.so was refused: found ABI") &&
                           Contains("'overlap_area' comes from " TALUS_PLUGINS) && !Contains("libother"));
  CHECK(count_of(json_of(scratch / "out/small/run.json")["warnings"].dump(), "was refused") == 1);
}

TEST_CASE("a run writes its results and will not overwrite them", "[apps][run]") {
  const Scratch scratch;
  const auto scene = scratch.write("small.json", small_scene());
  const Call call = call_talus(scratch.folder(), {"run", "small.json"});
  INFO(call.err);
  REQUIRE(call.code == 0);
  CHECK_THAT(call.out, Contains("finished at t = 0.2 s") && Contains("out/small"));
  CHECK_THAT(call.err, Contains("50 %"));
  const Series history = read_series(scratch / "out/small/history.csv");
  CHECK(history.names == std::vector<std::string>{"block.ux [m]", "block.uy [m]", "block.vx [m/s]",
                                                  "block.vy [m/s]", "block.speed [m/s]",
                                                  "block.rotation [deg]"});
  REQUIRE(history.time.size() == 21);
  CHECK(history.time.front() == 0);
  CHECK(history.time.back() == 0.2);
  CHECK(history.values[1].back() == Approx(-0.01).margin(2e-3));
  for (const char* name :
       {"frames.pvd", "frames/frame_000002.vtu", "frames/contacts_000002.vtu", "resolved.json"}) {
    CHECK(std::filesystem::exists(scratch / (std::string("out/small/") + name)));
  }
  const auto record = json_of(scratch / "out/small/run.json");
  CHECK(record["end"] == "finished");
  CHECK(record["scene"]["xxh3_128"] == hash_of_file(scene));
  CHECK(record["plugins"][0]["name"] == "overlap_area");
  CHECK(record["steps"] > 20);
  CHECK(record["blocks"] == 1);
  CHECK(record["state_hash"].get<std::string>().size() >= 16);

  const Call again = call_talus(scratch.folder(), {"run", "small.json"});
  CHECK(again.code == 2);
  CHECK_THAT(again.err, Contains("--overwrite"));
  const Call over = call_talus(
      scratch.folder(), {"run", "small.json", "--overwrite", "--quiet", "--threads", "2", "--no-skin"});
  CHECK(over.code == 0);
  CHECK(over.out.empty());
  CHECK(json_of(scratch / "out/small/run.json")["state_hash"] == record["state_hash"]);
}

TEST_CASE("a profile names the parts of the steps, and instruction sets are recorded", "[apps][run]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const Call call = call_talus(scratch.folder(), {"run", "small.json", "--profile", "--simd", "scalar"});
  INFO(call.err);
  REQUIRE(call.code == 0);
  for (const char* part : {"move", "boundary", "neighbours", "contacts", "loads", "materials", "velocities"})
    CHECK_THAT(call.out, Contains(part));
  const Call other = call_talus(scratch.folder(), {"run", "small.json", "--out", "best", "--quiet"});
  CHECK(other.out.empty());
  const auto scalar = json_of(scratch / "out/small/run.json"), best = json_of(scratch / "best/run.json");
  CHECK(scalar["settings"]["simd"] == "scalar");
  CHECK(scalar["state_hash"] == best["state_hash"]);
}

TEST_CASE("a run tells and records what slept", "[apps][run]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  // So large that the block stands still in the air.
  const Call call = call_talus(
      scratch.folder(),
      {"run", "small.json", "--set", R"(/sleep={"speed": 1e3, "acceleration": 1e6, "after": 1e-3})"});
  INFO(call.err);
  REQUIRE(call.code == 0);
  CHECK_THAT(call.out,
             Contains("islands that slept: 1, that woke: 0; bodies asleep at the end: 1; longest sleep"));
  CHECK_THAT(call.out, Contains("not followed: corners of"));
  const auto record = json_of(scratch / "out/small/run.json");
  const auto& sleep = record["sleep"];
  CHECK(sleep["islands"] == 1);
  CHECK(sleep["bodies_asleep"] == 1);
  CHECK(sleep["kinetic_energy [J/m]"] == record["ledger"]["sleep_loss [J/m]"]);
  const double speed = sleep["speed [m/s]"], acceleration = sleep["acceleration [m/s2]"],
               longest = sleep["longest [s]"];
  CHECK(speed > 0);
  CHECK(acceleration > 0);
  CHECK(longest > 0);
  CHECK(sleep["velocity_bound [m/s]"] == Approx(speed + acceleration * longest));
  CHECK(sleep["displacement_bound [m]"] == Approx(longest * (speed + acceleration * longest / 2)));

  REQUIRE(call_talus(scratch.folder(), {"run", "small.json", "-o", "awake"}).code == 0);
  CHECK_FALSE(json_of(scratch / "awake/run.json").contains("sleep"));
}

TEST_CASE("what was resolved runs to the same state", "[apps][run]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  REQUIRE(call_talus(scratch.folder(), {"run", "small.json", "--out", "a", "--set", "/time/end=0.1"}).code ==
          0);
  const Call call = call_talus(scratch.folder(), {"run", "a/resolved.json", "--out", "b"});
  INFO(call.err);
  REQUIRE(call.code == 0);
  CHECK(json_of(scratch / "a/run.json")["state_hash"] == json_of(scratch / "b/run.json")["state_hash"]);
  CHECK(json_of(scratch / "a/run.json")["settings"]["set"][0]["pointer"] == "/time/end");
}

TEST_CASE("bad files and scenes have their exit codes", "[apps][run]") {
  const Scratch scratch;
  const Call missing = call_talus(scratch.folder(), {"run", "absent.json"});
  CHECK(missing.code == 5);
  CHECK_THAT(missing.err, Contains("absent.json"));
  std::string text = small_scene();
  text.replace(text.find("\"gravity\""), 9, "\"gravitty\"");
  scratch.write("bad.json", text);
  for (const char* command : {"run", "validate"}) {
    const Call wrong = call_talus(scratch.folder(), {command, "bad.json"});
    CHECK(wrong.code == 2);
    CHECK(wrong.out.empty());
    CHECK_THAT(wrong.err, Contains("bad.json:5:") && Contains("gravitty") && Contains("gravity\""));
  }
  CHECK_FALSE(std::filesystem::exists(scratch / "out"));
  scratch.write("file", "");
  CHECK(call_talus(scratch.folder(), {"run", "bad.json", "--set", "/nope=1"}).code == 2);
}

TEST_CASE("the closing line counts all mistakes, also those that are not shown", "[apps][run]") {
  const Scratch scratch;
  const auto closing_line = [&](int mistakes) {
    std::string keys;
    for (int i = 0; i < mistakes; ++i) keys += fmt::format(R"("k{}": 1, )", i);
    scratch.write("scene.json", small_scene().insert(small_scene().find('{') + 1, keys));
    const std::string err = call_talus(scratch.folder(), {"run", "scene.json"}).err;
    return err.substr(err.rfind('\n', err.size() - 2) + 1);
  };
  CHECK(closing_line(1) == "1 mistake in the scene\n");
  CHECK(closing_line(1000) == "1000 mistakes in the scene\n");
  CHECK(closing_line(1001) == "1001 mistakes in the scene, the first 1000 of them shown\n");
  CHECK(closing_line(3000) == "3000 mistakes in the scene, the first 1000 of them shown\n");
}

TEST_CASE("validate says what a scene is", "[apps][validate]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const Call call = call_talus(scratch.folder(), {"validate", "small.json"});
  INFO(call.err);
  CHECK(call.code == 0);
  CHECK_THAT(call.out, Contains("no mistake") && Contains("2, 1 fixed, 1 with cover rigid") &&
                           Contains("overlap_area") && Contains("of critical") &&
                           Contains("block.speed [m/s]") && Contains("it names none by path"));
}

TEST_CASE("validate tells stiffness that is out of proportion, covers of many elements, settling and stages",
          "[apps][validate]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const auto told = [&](const std::vector<std::string>& changes) {
    std::vector<std::string> words{"validate", "small.json"};
    for (const std::string& change : changes) words.insert(words.end(), {"--set", change});
    const Call call = call_talus(scratch.folder(), words);
    INFO(call.err);
    REQUIRE(call.code == 0);
    return call.out;
  };
  const std::string rock =
      R"(/materials/rock={"density": 2000, "model": "linear_elastic", "young_modulus": 1e9, "poisson_ratio": 0.2})";
  // E/h is 1e9 Pa over the width of a metre.
  const std::string soft = told({rock, "/cover/model=block", "/interfaces/0/normal_stiffness=1e6",
                                 "/settle={\"duration\": 0.1, \"damping\": \"adaptive\"}"});
  CHECK_THAT(soft, Contains("1e+06 Pa/m of /interfaces/0 is 0.001 E/h of 'block'") &&
                       Contains("soft, bodies sink into each other rather than deform; E/h is 1e+09 Pa/m") &&
                       !Contains("which costs steps"));
  CHECK_THAT(soft, Contains("settle") && Contains("0.1 s with adaptive damping") && Contains("to settle") &&
                       Contains("not settled yet"));
  const std::string stiff = told({rock, "/cover/model=block", "/interfaces/0/normal_stiffness=1e12"});
  CHECK_THAT(stiff,
             Contains("stiff, which costs steps; 10 E/h is 1e+10 Pa/m") && !Contains("soft, bodies sink"));
  // Half of a metre over the speed of a bar's wave, 707 m/s.
  const std::string flutters = "a damping_time of about 0.0007 s stills it";
  CHECK_THAT(stiff, Contains(flutters) && Contains("/interfaces/0 has friction and 1e+03 E/h of 'block'"));
  CHECK_THAT(stiff, Contains("what slides may flutter, and be braked less than its friction, and what sticks "
                             "shudder and walk"));
  CHECK_THAT(soft, !Contains("flutter"));
  CHECK_THAT(told({rock, "/materials/rock/damping_time=1e-3", "/cover/model=block",
                   "/interfaces/0/normal_stiffness=1e12"}),
             !Contains("flutter"));
  const std::string covered =
      told({rock, R"(/cover={"model": "hexagonal", "size": 0.4})",
            R"(/stages=[{"name": "dry", "from": 0.1, "set": {"/gravity": [0, -9]}}])"});
  CHECK_THAT(covered, Contains(" patches, ") && Contains(" elements") && Contains("'dry' from 0.1 s"));
}

TEST_CASE("talus report writes the page of a folder of results, and names a folder that holds none",
          "[apps][report]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  REQUIRE(call_talus(scratch.folder(), {"run", "small.json", "--quiet", "--out", "results"}).code == 0);
  const std::string page = read_whole_file(scratch / "results/report.html");
  std::filesystem::remove(scratch / "results/report.html");
  const Call call = call_talus(scratch.folder(), {"report", "results"});
  CHECK(call.code == 0);
  CHECK(call.out == "results/report.html\n");
  CHECK(read_whole_file(scratch / "results/report.html") == page);
  const Call none = call_talus(scratch.folder(), {"report", "."});
  CHECK(none.code == 2);
  CHECK_FALSE(none.err.empty());
  CHECK_FALSE(std::filesystem::exists(scratch / "report.html"));
}

TEST_CASE("libraries that a scene names load only when allowed", "[apps][validate]") {
  const Scratch scratch;
  std::string text = small_scene();
  text.insert(text.find("\"title\""), "\"plugins\": [\"./libnowhere.so\"], ");
  scratch.write("foreign.json", text);
  const Call call = call_talus(scratch.folder(), {"validate", "foreign.json"});
  CHECK(call.code == 3);
  CHECK_THAT(call.out + call.err, Contains("./libnowhere.so") && Contains("--allow-plugins"));
  scratch.write("plain.json", small_scene());
  const Call set =
      call_talus(scratch.folder(), {"validate", "plain.json", "--set", R"(/plugins=["./libnowhere.so"])"});
  CHECK(set.code == 3);
  CHECK_THAT(set.err, Contains("./libnowhere.so") && Contains("--allow-plugins"));
  const Call no_path = call_talus(scratch.folder(), {"validate", "plain.json", "--set", "/plugins=[7]"});
  CHECK(no_path.code == 2);
}

TEST_CASE("a run that is interrupted leaves whole files", "[apps][run]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  for (const int signal : {SIGINT, SIGTERM}) {
    std::filesystem::remove_all(scratch / "out");  // the signal waits for the first frame
    const Call call = call_and_signal(scratch.folder(),
                                      {"run", "small.json", "--overwrite", "--set", "/time/end=1e5", "--set",
                                       "/output/frames=100", "--set", "/output/history=1"},
                                      signal, scratch / "out/small/frames.pvd");
    INFO(call.err);
    CHECK(call.code == 130);
    CHECK_THAT(call.err, Contains("interrupted at t = ") && Contains("out/small"));
    const auto record = json_of(scratch / "out/small/run.json");
    CHECK(record["end"] == "interrupted");
    const Series history = read_series(scratch / "out/small/history.csv");
    CHECK(history.time.back() == record["t [s]"].get<double>());
    CHECK_THAT(read_whole_file(scratch / "out/small/frames.pvd"), Contains("</VTKFile>"));
  }
}

TEST_CASE("numerical trouble is told, recorded and ends with its code", "[apps][run]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  // A hundred times the critical step.
  const Call call = call_talus(scratch.folder(), {"run", "small.json", "--set", "/time/dt=0.1", "--set",
                                                  "/output/history=0.1", "--set", "/time/end=20"});
  INFO(call.err);
  CHECK(call.code == 4);
  const auto record = json_of(scratch / "out/small/run.json");
  CHECK(record["end"] == "stopped");
  CHECK_THAT(call.err, Contains(record["trouble"].get<std::string>()));
  CHECK(std::filesystem::exists(scratch / "out/small/frames/frame_000000.vtu"));
}

TEST_CASE("a run that is stopped while it settles tells of its settling", "[apps][run]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const Call call =
      call_talus(scratch.folder(), {"run", "small.json", "--set", R"(/settle={"duration": 9, "damping": 1})",
                                    "--set", "/interfaces/0/normal_stiffness=1000"});
  INFO(call.err);
  CHECK(call.code == 4);
  CHECK_THAT(call.out, Contains(" of settling: ") && !Contains(": 0 steps") && Contains("largest overlap"));
  const auto record = json_of(scratch / "out/small/run.json");
  CHECK(record["steps"] == 0);
  CHECK(record["settle_steps"] > 0);
  CHECK(record["largest_penetration [m]"] > 0);
  CHECK(record["cost"]["settling"]["cpu [s]"] > 0);
  CHECK_THAT(call_talus(scratch.folder(), {"doctor", "out/small"}).out,
             Contains(fmt::format(" of settling after {} steps", record["settle_steps"].get<int>())));
}

TEST_CASE("a log for programs is one JSON object on each line", "[apps][log]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const auto logged = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"--log-format", "json"});
    std::vector<nlohmann::json> lines;
    std::istringstream stream(call_talus(scratch.folder(), words).err);
    for (std::string line; std::getline(stream, line);) {
      lines.push_back(nlohmann::json::parse(line));
      CHECK(lines.back()["time"].get<std::string>().size() == 24);
      CHECK((lines.back().contains("level") && lines.back().contains("event")));
    }
    return lines;
  };
  const auto run = logged({"run", "small.json"});
  REQUIRE(run.size() > 3);
  CHECK(run.front()["event"] == "started");
  CHECK(run.front()["scene"] == "small.json");
  CHECK(run[1]["event"] == "progress");
  CHECK(run[1]["share"] == Approx(0.1).margin(0.05));
  CHECK(run.back()["event"] == "finished");
  CHECK(run.back()["state_hash"] == json_of(scratch / "out/small/run.json")["state_hash"]);
  const auto again = logged({"run", "small.json"});
  REQUIRE(again.size() == 1);
  CHECK(again[0]["level"] == "error");
  CHECK_THAT(again[0]["message"].get<std::string>(), Contains("--overwrite"));
  const auto wrong = logged({"run", "small.json", "--set", "/time/end=-1"});
  CHECK(wrong.at(0)["pointer"] == "/time/end");
  CHECK(logged({"run", "small.json", "--wat"}).at(0)["level"] == "error");
  const auto compared = logged({"compare", "small.json", "--vary", "/time/dt=1e-4,5e-5"});
  CHECK(compared.front()["vary"] == "/time/dt=1e-4,5e-5");
  CHECK(compared.back()["event"] == "compared");
  CHECK(compared.back()["exit_code"] == 0);
}

TEST_CASE("a log level keeps the rest from stderr, and a warning is told once", "[apps][log]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const auto told = [&](const char* level) {
    return call_talus(scratch.folder(), {"run", "small.json", "--overwrite", "--set",
                                         "/contact/model=frictionless", "--log-level", level})
        .err;
  };
  CHECK(told("error").empty());
  const std::string warnings = told("warning");
  CHECK_THAT(warnings, Contains("frictionless reads no friction_angle") && !Contains("50 %"));
  CHECK(count_of(warnings, "frictionless reads no") == 3);
  CHECK_THAT(told("info"), Contains("50 %"));
  const Call compared = call_talus(scratch.folder(), {"compare", "small.json", "--vary", "/time/end=0.1,0.2",
                                                      "--set", "/contact/model=frictionless", "--quiet"});
  CHECK(count_of(compared.err, "frictionless reads no") == 3);
  const Call call = call_talus(scratch.folder(), {"run", "small.json", "--log-level", "loud"});
  CHECK(call.code == 2);
  CHECK_THAT(call.err, Contains("--log-level loud: allowed are error, warning, info"));
  CHECK_THAT(call_talus(scratch.folder(), {"resume", "out/small", "--log-format", "xml"}).err,
             Contains("--log-format xml: allowed are text, json"));
}

TEST_CASE("what cannot be run removes no results", "[apps][run]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  REQUIRE(call_talus(scratch.folder(), {"run", "small.json", "--quiet", "--out", "kept"}).code == 0);
  const std::string before = read_whole_file(scratch / "kept/history.csv");
  const Call call = call_talus(scratch.folder(), {"run", "small.json", "--quiet", "--out", "kept",
                                                  "--overwrite", "--set", "/time/dt=1e-300"});
  CHECK(call.code == 2);
  CHECK_THAT(call.err, Contains("/time/dt of 1e-300 s makes"));
  CHECK(read_whole_file(scratch / "kept/history.csv") == before);
}
