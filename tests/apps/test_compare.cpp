#include "files/folder_lock.hpp"
#include "files/whole_file.hpp"
#include "output/scratch.hpp"
#include "output/series.hpp"
#include "program.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <csignal>

using namespace talus;
using Catch::Matchers::Contains;

namespace {

std::string scene_with(const std::string& line) {
  std::string text = small_scene();
  return text.insert(text.find("\"title\""), line + ", ");
}

}  // namespace

TEST_CASE("compare runs laws side by side from one geometry at one step", "[apps][compare]") {
  const Scratch scratch;
  scratch.write("small.json", scene_with("\"settle\": {\"duration\": 0.3, \"damping\": 30}"));
  const Call call = call_talus(scratch.folder(), {"compare", "small.json", "--vary",
                                                  "/contact/model=overlap_area,vertex_edge", "--at", "0.1"});
  INFO(call.err);
  REQUIRE(call.code == 0);
  CHECK_THAT(call.out, Contains("vertex_edge") && Contains("block.speed [m/s]") && Contains("at 0.1 s"));
  const Series series = read_series(scratch / "out/small-compare/compare.csv");
  CHECK(series.column("overlap_area/block.speed [m/s]"));
  CHECK(series.column("vertex_edge/block.speed [m/s]"));
  CHECK(series.time.size() == 21);
  const auto json = json_of(scratch / "out/small-compare/compare.json");
  CHECK(json["runs"][0]["dt [s]"] == json["runs"][1]["dt [s]"]);
  CHECK(json["runs"][0]["steps"] == json["runs"][1]["steps"]);
  CHECK(json["runs"][0]["settled_difference [m]"] == 0);
  CHECK(json["runs"][1]["settled_difference [m]"].get<double>() < 1e-4);
  for (const char* file : {"overlap_area/run.json", "vertex_edge/history.csv", "vertex_edge/resolved.json"}) {
    CHECK(std::filesystem::exists(scratch / (std::string("out/small-compare/") + file)));
  }
  CHECK_THAT(read_whole_file(scratch / "out/small-compare/report.html"),
             Contains("--vary /contact/model=overlap_area,vertex_edge --at 0.1"));
  const Call again = call_talus(
      scratch.folder(), {"compare", "small.json", "--vary", "/contact/model=overlap_area,vertex_edge"});
  CHECK(again.code == 2);
  CHECK_THAT(again.err, Contains("--overwrite"));
  const Call doctor = call_talus(scratch.folder(), {"doctor", "out/small-compare"});
  CHECK(doctor.code == 2);
  CHECK_THAT(doctor.err, Contains("holds several runs"));
}

TEST_CASE("equal scenes compare equal: the baseline settles as the others do", "[apps][compare]") {
  const Scratch scratch;
  scratch.write("small.json", scene_with("\"settle\": {\"duration\": 0.3, \"damping\": 30}"));
  const std::vector<std::string> skewed{"--set",
                                        "/bodies/1/polygon=[[0,0.01],[1,0.01],[1.4,1.01],[0.4,1.01]]"};
  const Call call =
      call_talus(scratch.folder(), {"compare", "small.json", "--vary", "/title=a,b", skewed[0], skewed[1]});
  INFO(call.err);
  REQUIRE(call.code == 0);
  for (const char* file : {"history.csv", "energy.csv"}) {
    CHECK(read_whole_file(scratch / "out/small-compare/a" / file) ==
          read_whole_file(scratch / "out/small-compare/b" / file));
  }
  CHECK(json_of(scratch / "out/small-compare/compare.json")["runs"][1]["settled_difference [m]"] == 0);
}

TEST_CASE("a comparison of ways to settle says where all of them begin", "[apps][compare]") {
  const Scratch scratch;
  scratch.write("small.json", scene_with("\"settle\": {\"duration\": 0.1, \"damping\": 30}"));
  const Call call =
      call_talus(scratch.folder(), {"compare", "small.json", "--vary", "/settle/duration=0.1,0.2"});
  CHECK(call.code == 0);
  CHECK_THAT(call.err, Contains("all runs settle from what '0.1' settled to"));
}

TEST_CASE("runs whose patches are others settle by themselves, and say so", "[apps][compare]") {
  const Scratch scratch;
  scratch.write("small.json", scene_with("\"settle\": {\"duration\": 0.05, \"damping\": 30}"));
  const Call call = call_talus(
      scratch.folder(),
      {"compare", "small.json", "--vary", "/cover/slivers=keep,merge", "--set",
       R"(/cover={"model": "hexagonal", "size": 0.3})", "--set",
       R"(/materials/rock={"density": 2000, "model": "linear_elastic", "young_modulus": 1e9, "poisson_ratio": 0.2})",
       "--set", "/bodies/1/polygon=[[0,0.01],[1,0.01],[1,2.06],[0,2.06]]", "--set", "/time/end=0.02"});
  INFO(call.err);
  REQUIRE(call.code == 0);
  CHECK_THAT(call.err, Contains("'merge' settled by itself"));
}

TEST_CASE("a comparison that cannot be made removes no results", "[apps][compare]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  REQUIRE(call_talus(scratch.folder(), {"compare", "small.json", "--vary", "/title=a,b"}).code == 0);
  const std::string before = read_whole_file(scratch / "out/small-compare/compare.csv");
  const Call call = call_talus(scratch.folder(),
                               {"compare", "small.json", "--vary", "/time/dt=1e-4,1e-300", "--overwrite"});
  CHECK(call.code == 2);
  CHECK_THAT(call.err, Contains("/time/dt of 1e-300 s makes"));
  CHECK(read_whole_file(scratch / "out/small-compare/compare.csv") == before);
}

TEST_CASE("compare says with which value a scene has a mistake", "[apps][compare]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const Call call =
      call_talus(scratch.folder(), {"compare", "small.json", "--vary", "/cover/model=rigid,bloc"});
  CHECK(call.code == 2);
  CHECK_THAT(call.err, Contains("with /cover/model = bloc:\n") && !Contains("= rigid"));
}

TEST_CASE("each run keeps its own step where the time settings vary", "[apps][compare]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const Call call = call_talus(scratch.folder(),
                               {"compare", "small.json", "--vary", "/time/dt=1e-4,5e-5", "--out", "order"});
  INFO(call.err);
  REQUIRE(call.code == 0);
  const auto json = json_of(scratch / "order/compare.json");
  CHECK(json["common_dt [s]"].is_null());
  CHECK(json["runs"][1]["steps"] == 2 * json["runs"][0]["steps"].get<int>());
}

TEST_CASE("what runs cost at their own steps is told of steps that they would make", "[apps][compare]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const auto compared = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"compare", "small.json", "--out", "out", "--overwrite"};
    words.insert(words.end(), more.begin(), more.end());
    const Call call = call_talus(scratch.folder(), words);
    INFO(call.err);
    REQUIRE(call.code == 0);
    return std::pair(json_of(scratch / "out/compare.json"), call.out + call.err);
  };
  const auto [steps, words] = compared({"--vary", "/time/dt=1e-4,5e-5"});
  for (const auto& run : steps["runs"]) CHECK(run["own_steps"] == run["steps"]);
  CHECK(steps["runs"][1]["own_dt [s]"] == 5e-5);

  const auto [alike, nothing] = compared({"--vary", "/contact/model=overlap_area,vertex_edge"});
  for (const auto& run : alike["runs"]) CHECK(run["own_steps"].get<double>() <= run["steps"].get<double>());
  CHECK_THAT(nothing, !Contains("bound its own more"));

  const auto [fixed, quiet] =
      compared({"--vary", "/contact/model=overlap_area,vertex_edge", "--set", "/time/dt=5e-5"});
  CHECK_FALSE(fixed["runs"][1]["cost_at_own_dt"].is_null());
  CHECK_THAT(quiet, !Contains("bound its own more"));

  // From half of the time on one law alone bounds the step by stiffer springs.
  const auto [staged, told] = compared(
      {"--vary", "/contact/model=overlap_area,vertex_edge", "--set",
       R"(/stages=[{"name": "stiff", "from": 0.1, "set": {"/interfaces/0/normal_stiffness": 1e12}}])"});
  CHECK(staged["runs"][0]["cost_at_own_dt"].is_null());
  CHECK_THAT(told, Contains("bound its own more from some time on"));
}

TEST_CASE("a step that the scene states is told as that, and what it costs at the automatic one is, too",
          "[apps][compare]") {
  const Scratch scratch;
  scratch.write("small.json", scene_with("\"settle\": {\"duration\": 0.05, \"damping\": 30}"));
  const std::vector<std::string> words{"compare", "small.json", "--vary", "/title=a,b", "--overwrite"};
  REQUIRE(call_talus(scratch.folder(), words).code == 0);
  const double own = json_of(scratch / "out/small-compare/compare.json")["runs"][0]["own_dt [s]"];
  std::vector<std::string> stated = words;
  stated.insert(stated.end(), {"--set", fmt::format("/time/dt={}", 1.5 * own)});
  const Call call = call_talus(scratch.folder(), stated);
  INFO(call.out << call.err);
  REQUIRE(call.code == 0);
  CHECK_THAT(call.out, Contains("the step that the scene states, "));
  CHECK_THAT(call.err, !Contains("bound its own more"));
  const auto json = json_of(scratch / "out/small-compare/compare.json");
  CHECK(json["common_dt [s]"].get<double>() == Approx(1.5 * own));
  const auto run = json["runs"][1];
  CHECK(run["own_steps"].get<double>() > run["steps"].get<double>());
  CHECK(run["cost_at_own_dt"].is_number());

  std::vector<std::string> staged{
      "compare",
      "small.json",
      "--overwrite",
      "--set",
      fmt::format("/time/dt={}", own / 9),
      "--vary",
      R"(/stages=[],[{"name": "s", "from": 0.1, "set": {"/interfaces/0/normal_stiffness": 1e10}}])"};
  const Call stiffer = call_talus(scratch.folder(), staged);
  INFO(stiffer.out << stiffer.err);
  REQUIRE(stiffer.code == 0);
  CHECK_THAT(stiffer.err,
             Contains("a stage bound the step of '[{") && !Contains("a stage bound the step of '[]'"));
  const auto of_stage = json_of(scratch / "out/small-compare/compare.json");
  CHECK(of_stage["runs"][0]["own_steps"].is_number());
  CHECK(of_stage["runs"][1]["own_steps"].is_null());
}

TEST_CASE("columns of a reference in another unit are named", "[apps][compare]") {
  const Scratch scratch;
  scratch.write("small.json", scene_with("\"settle\": {\"duration\": 0.05, \"damping\": 30}"));
  scratch.write("reference.csv", "t [s],block.speed [m/s],block.ux [mm]\n0,0,0\n1,1,1\n");
  const Call call = call_talus(
      scratch.folder(), {"compare", "small.json", "--vary", "/title=a", "--reference", "reference.csv"});
  INFO(call.err);
  CHECK(call.code == 0);
  CHECK_THAT(call.err, Contains("'block.ux [mm]' was left out, for the runs have 'block.ux [m]'") &&
                           !Contains("'block.speed [m/s]' was left out"));
}

TEST_CASE("a comparison keeps the reference it was made with, and overwrites no other", "[apps][compare]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const std::string curve = "t [s],block.uy [m]\n0,0\n1,0.125\n";
  scratch.write("curve.csv", curve);
  const std::vector<std::string> words{"compare",     "small.json", "--vary", "/contact/model=overlap_area",
                                       "--reference", "curve.csv",  "--out",  "b"};
  REQUIRE(call_talus(scratch.folder(), words).code == 0);
  CHECK(read_whole_file(scratch / "b/compare_reference.csv") == curve);

  // Its report asks for no file beyond the folder, wherever one stands.
  scratch.write("curve.csv", "t [s],block.uy [m]\n0,0\n1,9\n");
  const std::string page = read_whole_file(scratch / "b/report.html");
  REQUIRE(call_talus(scratch / "b", {"report", "."}).code == 0);
  CHECK(read_whole_file(scratch / "b/report.html") == page);

  std::filesystem::create_directory(scratch / "mine");
  scratch.write("mine/compare_reference.csv", "mine");
  std::vector<std::string> elsewhere = words;
  elsewhere.back() = "mine";
  CHECK(call_talus(scratch.folder(), elsewhere).code == 2);
  CHECK(read_whole_file(scratch / "mine/compare_reference.csv") == "mine");
}

TEST_CASE("a comparison that would replace its own reference removes no results", "[apps][compare]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  REQUIRE(
      call_talus(scratch.folder(), {"compare", "small.json", "--vary", "/title=a,b", "--out", "c"}).code ==
      0);
  const Call call = call_talus(scratch.folder(), {"compare", "small.json", "--vary", "/title=a,b", "--out",
                                                  "c", "--overwrite", "--reference", "c/b/history.csv"});
  CHECK(call.code == 2);
  CHECK_THAT(call.err, Contains("'c/b/history.csv' is read to make the results"));
  for (const char* file :
       {"c/compare.csv", "c/compare.json", "c/a/history.csv", "c/a/run.json", "c/b/history.csv"})
    CHECK(std::filesystem::exists(scratch / file));
}

TEST_CASE("a warning of the scene is told once, and stands once in each record", "[apps][compare]") {
  const Scratch scratch;
  const std::string row = R"("normal_stiffness": 1e8, "tangential_stiffness": 1e8, "friction_angle": 9,
                            "normal_damping": 0, "tangential_damping": 0)";
  const std::string twice = fmt::format(
      R"(/interfaces=[{{"between": ["rock", "rock"], {0}}}, {{"between": ["rock", "*"], {0}}}])", row);
  scratch.write("small.json", scene_with(R"("settle": {"duration": 0.01, "damping": 10})"));
  const auto times = [](const std::string& text) {
    std::size_t count = 0;
    for (std::size_t at = text.find("never applies"); at != std::string::npos;
         at = text.find("never applies", at + 1))
      ++count;
    return count;
  };
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"run", "small.json", "--out", "r"},
        {"compare", "small.json", "--vary", "/title=a,b", "--out", "c"},
        {"safety", "small.json", "--out", "s"},
        {"validate", "small.json"}}) {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"--set", twice, "--set", "/time/end=0.02"});
    const Call call = call_talus(scratch.folder(), all);
    INFO(words[0] << call.out << call.err);
    CHECK(times(call.out + call.err) == 1);
  }
  for (const char* record : {"r/run.json", "c/a/run.json", "c/b/run.json", "s/safety.json"})
    CHECK(times(read_whole_file(scratch / record)) == 1);
}

TEST_CASE("a broken tolerance has its own exit code", "[apps][compare]") {
  const Scratch scratch;
  scratch.write("small.json", scene_with("\"tolerances\": [{\"monitor\": \"block\", \"quantity\": \"uy\", "
                                         "\"against\": \"reference\", \"largest\": 1e-3}]"));
  const Call first = call_talus(scratch.folder(), {"run", "small.json", "--out", "a"});
  REQUIRE(first.code == 0);
  const std::vector<std::string> words{
      "compare", "small.json", "--vary",     "/contact/model=overlap_area", "--reference", "a/history.csv",
      "--out",   "b",          "--overwrite"};
  const Call held = call_talus(scratch.folder(), words);
  INFO(held.err);
  CHECK(held.code == 0);
  CHECK(json_of(scratch / "b/compare.json")["tolerances_held"] == true);
  scratch.write("a/history.csv", "t [s],block.uy [m]\n0,0\n1,1\n");
  const Call broken = call_talus(scratch.folder(), words);
  CHECK(broken.code == 6);
  CHECK_THAT(broken.out, Contains("BROKEN"));
  CHECK(json_of(scratch / "b/compare.json")["tolerances"][0]["verdict"] == "broken");
  scratch.write("a/history.csv", "t [s],block.uy\n0,0\n");
  CHECK(call_talus(scratch.folder(), words).code == 2);
}

TEST_CASE("a comparison that is made anew leaves no runs of other values beside its own", "[apps][compare]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  REQUIRE(
      call_talus(scratch.folder(), {"compare", "small.json", "--vary", "/title=a,b,c", "--out", "o"}).code ==
      0);
  scratch.write("o/b/notes.txt", "mine");
  const Call call = call_talus(
      scratch.folder(), {"compare", "small.json", "--vary", "/title=a,d", "--out", "o", "--overwrite"});
  INFO(call.err);
  REQUIRE(call.code == 0);
  CHECK(std::filesystem::exists(scratch / "o/d/run.json"));
  CHECK_FALSE(std::filesystem::exists(scratch / "o/c"));
  CHECK_FALSE(std::filesystem::exists(scratch / "o/b/run.json"));
  CHECK(std::filesystem::exists(scratch / "o/b/notes.txt"));

  // A run that is read to make others stays.
  const Call from_run = call_talus(scratch.folder(), {"compare", "o/d/resolved.json", "--vary", "/title=a,e",
                                                      "--out", "o", "--overwrite"});
  INFO(from_run.err);
  REQUIRE(from_run.code == 0);
  CHECK(std::filesystem::exists(scratch / "o/e/run.json"));
  CHECK(std::filesystem::exists(scratch / "o/d/run.json"));
}

TEST_CASE("resume says of a comparison, and of each of its runs, that it begins anew",
          "[apps][compare][resume]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const Call broken = call_and_signal(
      scratch.folder(),
      {"compare", "small.json", "--vary", "/title=a,b", "--out", "o", "--set", "/time/end=200"}, SIGINT,
      scratch / "o/a/history.csv");
  INFO(broken.err);
  REQUIRE(broken.code == 130);
  for (const char* folder : {"o", "o/a", "o/b"}) {
    const Call call = call_talus(scratch.folder(), {"resume", folder});
    CHECK(call.code == 2);
    CHECK_THAT(call.err, Contains("is of a comparison, which keeps no checkpoint"));
  }
}

TEST_CASE("a comparison that cannot have all its folders takes nothing away", "[apps][compare]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const auto compare = [&](const std::string& values) {
    return call_talus(scratch.folder(), {"compare", "small.json", "--vary", "/title=" + values, "--out", "o",
                                         "--overwrite", "--set", "/time/end=0.1"});
  };
  REQUIRE(compare("a,b,c").code == 0);
  std::filesystem::create_symlink("nowhere", scratch / "o/d");
  CHECK_THAT(compare("a,d").err, Contains("o/d' is in the way"));
  const FolderLock lock(scratch / "o/c");
  for (const char* values : {"a,c", "a,b"}) {  // the last leaves over what is being written
    const Call call = compare(values);
    CHECK(call.code == 2);
    CHECK_THAT(call.err, Contains("o/c' is being written by another talus"));
    for (const char* file : {"o/compare.csv", "o/report.html", "o/a/history.csv", "o/b/run.json"}) {
      INFO(file);
      CHECK(std::filesystem::exists(scratch / file));
    }
  }
  CHECK_THAT(call_talus(scratch.folder(), {"compare", "small.json", "--vary", "/title=a:b,a/b"}).err,
             Contains("would both go to a folder 'a_b'"));
}

TEST_CASE("nobody writes into a folder that a comparison fills", "[apps][compare]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  REQUIRE(
      call_talus(scratch.folder(), {"compare", "small.json", "--vary", "/title=a,b", "--out", "o"}).code ==
      0);
  const std::string before = read_whole_file(scratch / "o/a/run.json");
  const FolderLock lock(scratch / "o");
  std::filesystem::create_directory_symlink("o/a", scratch / "link");
  for (const char* folder : {"o/a", "o/a/", "o/deeper/within", "link"}) {
    const Call call = call_talus(scratch.folder(), {"run", "small.json", "--out", folder, "--overwrite"});
    CHECK(call.code == 2);
    CHECK_THAT(call.err, Contains("o' is being written by another talus"));
  }
  CHECK(read_whole_file(scratch / "o/a/run.json") == before);
  // Beside a single run there is room.
  std::filesystem::create_directory(scratch / "single");
  const FolderLock of_run(scratch / "single");
  CHECK(call_talus(scratch.folder(), {"run", "small.json", "--out", "single/other", "--quiet"}).code == 0);
}

TEST_CASE("a comparison that was killed leaves no runs beside those of the next", "[apps][compare]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const Call killed = call_and_signal(
      scratch.folder(),
      {"compare", "small.json", "--vary", "/title=a,b", "--out", "o", "--set", "/time/end=200"}, SIGKILL,
      scratch / "o/a/history.csv");
  REQUIRE(killed.code == 128 + SIGKILL);
  REQUIRE(json_of(scratch / "o/compare.json")["ended"] == false);
  const Call report = call_talus(scratch.folder(), {"report", "o"});
  CHECK(report.code == 2);
  CHECK_THAT(report.err, Contains("was broken off before its end"));
  const std::vector<std::string> next{"compare", "small.json", "--vary", "/title=c,d", "--out", "o"};
  CHECK_THAT(call_talus(scratch.folder(), next).err, Contains("'o' holds results already"));
  std::vector<std::string> anew = next;
  anew.emplace_back("--overwrite");
  REQUIRE(call_talus(scratch.folder(), anew).code == 0);
  CHECK_FALSE(std::filesystem::exists(scratch / "o/a"));
  CHECK(json_of(scratch / "o/compare.json")["runs"][1]["end"] == "finished");
}

TEST_CASE("a damaged record of a comparison leads to no folder beside its own", "[apps][compare]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  REQUIRE(call_talus(scratch.folder(), {"run", "small.json", "--out", "all", "--quiet"}).code == 0);
  std::filesystem::create_directory(scratch / "all/o");
  scratch.write("all/o/compare.json", R"({"varied": "/title", "runs": [{"value": "a", "folder": ".."}]})");
  const Call call = call_talus(scratch.folder(), {"compare", "small.json", "--vary", "/title=b,c", "--out",
                                                  "all/o", "--overwrite", "--set", "/time/end=0.1"});
  INFO(call.err);
  CHECK(call.code == 0);
  CHECK(std::filesystem::exists(scratch / "all/run.json"));
}
