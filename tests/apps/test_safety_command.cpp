#include "files/whole_file.hpp"
#include "output/scratch.hpp"
#include "program.hpp"

#include <catch2/catch.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <numbers>
#include <sstream>

using namespace talus;
using Catch::Matchers::Contains;

namespace {

Call reduce(const Scratch& scratch, const std::vector<std::string>& more) {
  std::vector<std::string> words{
      "safety", TALUS_SCENES "/stick_31deg.json", "--set", "/time/end=0.5", "--out", "results"};
  words.insert(words.end(), more.begin(), more.end());
  return call_talus(scratch.folder(), words);
}

}  // namespace

TEST_CASE(
    "talus safety tells the factor between what stands and what collapses, and writes each factor it tried",
    "[apps][safety]") {
  const Scratch scratch;
  const Call call = reduce(scratch, {"--tolerance", "0.1"});
  INFO(call.out << call.err);
  REQUIRE(call.code == 0);
  double factor = 0, stands = 0, collapses = 0;
  REQUIRE(std::sscanf(call.out.substr(call.out.find("factor of safety")).c_str(),
                      "factor of safety %lf: stands at %lf, collapses at %lf", &factor, &stands,
                      &collapses) == 3);
  CHECK(stands < factor);
  CHECK(factor < collapses);
  CHECK(collapses - stands <= 0.1 * stands * (1 + 1e-3));  // printed with four digits
  const double degree = std::numbers::pi / 180, due = std::tan(31 * degree) / std::tan(30 * degree);
  CHECK(stands <= due);
  CHECK(due <= collapses);
  CHECK_THAT(call.out, Contains("failing at ") && Contains("results in results"));

  const nlohmann::json answer = nlohmann::json::parse(read_whole_file(scratch / "results/safety.json"));
  CHECK(answer.at("stands").get<double>() < answer.at("factor").get<double>());
  CHECK(answer.at("collapses").get<double>() > answer.at("factor").get<double>());
  CHECK(answer.at("end") == "finished");
  std::istringstream csv(read_whole_file(scratch / "results/safety.csv"));
  std::string line;
  std::getline(csv, line);
  CHECK(line ==
        "factor,collapsed,displacement [m],body,kinetic [J/m],failing bodies,stopped by,lasted [s],still "
        "moving");
  double last_factor = 0;
  int last_collapsed = 0, rows = 0;
  for (; std::getline(csv, line); ++rows) {
    double tried = 0;
    int collapsed = 0;
    REQUIRE(std::sscanf(line.c_str(), "%lf,%d,", &tried, &collapsed) == 2);
    CHECK(tried > last_factor);  // in their order, not in that of the bisection
    CHECK(collapsed >= last_collapsed);
    last_factor = tried, last_collapsed = collapsed;
  }
  CHECK(rows >= 3);
  CHECK_THAT(read_whole_file(scratch / "results/safety.svg"),
             Contains("<svg") && Contains("factor of safety 1.0"));
  CHECK_THAT(read_whole_file(scratch / "results/mechanism.svg"),
             Contains("<svg") && Contains("<title>block</title>") && Contains("collapse at a factor of 1.0"));
}

TEST_CASE("talus safety says what collapses however strong, and what stands however weak", "[apps][safety]") {
  const Scratch scratch;
  const Call fallen = reduce(scratch, {"--set", "/interfaces/0/friction_angle=0.1"});
  CHECK(fallen.code == 0);
  CHECK_THAT(fallen.out, Contains("it collapses even with ") && Contains("look whether it can stand at all"));
  const Call slid = reduce(scratch, {"--overwrite", "--set", "/interfaces/0/friction_angle=20", "--set",
                                     R"(/settle={"duration": 2, "damping": 5, "hold_stick": false})"});
  INFO(slid.out << slid.err);
  CHECK(slid.code == 0);
  CHECK_THAT(slid.out, Contains("what was left after settling ") && !Contains("it collapses"));
  const Call steady = reduce(scratch, {"--overwrite", "--set", "/gravity=[0, 0]"});
  CHECK(steady.code == 0);
  CHECK_THAT(steady.out, Contains("it stands even with its strength divided by "));
}

TEST_CASE("talus safety overwrites nothing unasked, and refuses tolerances that tell nothing",
          "[apps][safety]") {
  const Scratch scratch;
  std::filesystem::create_directory(scratch / "results");
  scratch.write("results/safety.json", "mine");
  CHECK(reduce(scratch, {}).code != 0);
  scratch.write("results/safety.csv", "mine");
  const Call twice = reduce(scratch, {});
  CHECK(twice.code != 0);
  CHECK_THAT(twice.err, Contains("--overwrite"));
  CHECK(read_whole_file(scratch / "results/safety.csv") == "mine");
  for (const char* tolerance : {"0", "1", "-0.1", "nan"}) {
    const Call call = reduce(scratch, {std::string("--tolerance=") + tolerance});
    CHECK(call.code == 2);
    CHECK_THAT(call.err, Contains("allowed are 1e-6 to less than 1"));
  }
}

TEST_CASE("talus safety of a scene that has nothing to reduce removes no results", "[apps][safety]") {
  const Scratch scratch;
  std::filesystem::create_directory(scratch / "results");
  scratch.write("results/safety.csv", "mine");
  const Call call = reduce(scratch, {"--overwrite", "--set", "/interfaces/0/friction_angle=0"});
  CHECK(call.code == 2);
  CHECK_THAT(call.err, Contains("has friction, cohesion or tensile strength to reduce"));
  CHECK(read_whole_file(scratch / "results/safety.csv") == "mine");
}

TEST_CASE("talus safety and compare replace no table that their scene reads", "[apps][safety][compare]") {
  const Scratch scratch;
  const std::string table = "t [s],a [m/s2]\n0,0\n1,0\n";
  std::filesystem::create_directory(scratch / "results");
  scratch.write("results/energy.csv", table);
  const std::string shaken =
      "/base_acceleration=[{\"time\": \"" + (scratch / "results/energy.csv").string() + "\"}, 0]";
  const Call safety = reduce(scratch, {"--overwrite", "--set", shaken});
  CHECK(safety.code == 2);
  CHECK_THAT(safety.err, Contains("is read to make the results that would replace it"));
  const Call compare = call_talus(scratch.folder(), {"compare", TALUS_SCENES "/stick_31deg.json", "--vary",
                                                     "/contact/model=overlap_area,vertex_edge", "--set",
                                                     shaken, "--out", "results", "--overwrite"});
  CHECK(compare.code == 2);
  CHECK_THAT(compare.err, Contains("is read to make the results that would replace it"));
  CHECK(read_whole_file(scratch / "results/energy.csv") == table);
}

TEST_CASE("talus safety does not take trouble at any strength for a collapse", "[apps][safety]") {
  const Scratch scratch;
  const Call call = call_talus(
      scratch.folder(), {"safety", TALUS_SCENES "/column.json", "--set", "/time/dt=2e-4", "--out", "column"});
  CHECK(call.code == 4);
  CHECK_THAT(call.err,
             Contains("runs with 1 to 9.31 times the strength are all stopped") && Contains("the step"));
  // All of them start from where the scene settles to, which is told with what that says.
  const Call settled = call_talus(
      scratch.folder(), {"safety", TALUS_SCENES "/column.json", "--set", "/time/dt=2e-4", "--set",
                         R"(/settle={"duration": 0.001, "damping": 10, "until": 1e-6})", "--out", "settled"});
  CHECK(settled.code == 4);
  CHECK_THAT(settled.err,
             Contains("warning: settling ended with its duration") && Contains("with its own strength"));
}

TEST_CASE("talus safety tells a run that was stopped from one that collapsed", "[apps][safety]") {
  const Scratch scratch;
  const Call call = reduce(scratch, {"--tolerance", "0.2", "--set", "/limits/energy_residual=1e-9"});
  INFO(call.out << call.err);
  REQUIRE(call.code == 0);
  CHECK_THAT(call.out, Contains("1.25  stopped"));
  CHECK_THAT(call.err, Contains("counts as a collapse because it was stopped: ") && Contains("energy"));
  CHECK_THAT(read_whole_file(scratch / "results/safety.csv"), Contains("1.25,1,,,,,"));
}

TEST_CASE("talus safety that is interrupted gives no factor", "[apps][safety]") {
  const Scratch scratch;
  const Call call = call_and_signal_after(
      scratch.folder(),
      {"safety", TALUS_SCENES "/stick_31deg.json", "--set", "/time/dt=1e-6", "--out", "results"}, SIGINT, 1);
  INFO(call.out << call.err);
  CHECK(call.code == 130);
  CHECK_THAT(call.out, Contains("interrupted: found to stand at ") && !Contains("factor of safety"));
  CHECK_THAT(read_whole_file(scratch / "results/safety.svg"), !Contains("factor of safety"));
}

TEST_CASE("talus safety that is interrupted keeps what it warned of", "[apps][safety]") {
  const Scratch scratch;
  const Call call =
      call_and_signal_after(scratch.folder(),
                            {"safety", TALUS_SCENES "/stick_31deg.json", "--set", "/time/dt=1e-6", "--set",
                             "/time/end=0.01", "--tolerance", "1e-4", "--out", "results"},
                            SIGINT, 1);
  INFO(call.out << call.err);
  REQUIRE(call.code == 130);
  CHECK_THAT(call.err, Contains("too short to see a body fail"));
  const nlohmann::json answer = json_of(scratch / "results/safety.json");
  CHECK(answer.at("warnings").dump().find("too short to see a body fail") != std::string::npos);
  CHECK(answer.at("factor").is_null());
}

TEST_CASE("talus safety tells what may flutter, as validate does", "[apps][safety]") {
  const Scratch scratch;
  const std::vector<std::string> quick{"--tolerance",    "0.5",   "--set",
                                       "/time/end=0.05", "--set", "/settle/duration=0.02"};
  CHECK(reduce(scratch, quick).err.find("may flutter") == std::string::npos);
  std::vector<std::string> stiff = quick;
  stiff.insert(stiff.end(), {"--set", "/interfaces/0/normal_stiffness=1e11", "--overwrite"});
  const Call call = reduce(scratch, stiff);
  CHECK(call.code == 0);
  CHECK_THAT(call.err, Contains("what slides may flutter") && Contains("damping_time of about"));
}
