#include "files/whole_file.hpp"
#include "limited.hpp"
#include "output/scratch.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>

using namespace talus;
using Catch::Matchers::Contains;

namespace {

std::vector<std::string> run_words(const std::string& out) {
  return {"run",   "small.json",   "--quiet", "--no-report",          "--out", out,
          "--set", "/time/end=20", "--set",   "/output/history=0.02", "--set", "/output/frames=2"};
}

/// Files that are half written under the name of a whole one.
bool has_parts(const std::filesystem::path& folder) {
  const std::filesystem::recursive_directory_iterator all(folder);
  return std::any_of(begin(all), end(all),
                     [](const auto& entry) { return entry.path().extension() == ".part"; });
}

/// As in "holds the state at t = 0.0625 s", of six digits.
double time_of_state(const std::string& err) {
  const std::string before = "holds the state at t = ";
  const std::size_t at = err.find(before);
  REQUIRE(at != std::string::npos);
  return std::stod(err.substr(at + before.size()));
}

/// A history up to the middle of the last line that any state of that time needs: the last row that is surely
/// earlier, however its time was rounded, or the names of the columns.
std::string cut_before(double time, const std::string& history) {
  std::size_t end = history.find('\n');
  for (std::size_t row = end + 1, next = 0; row < history.size(); row = next + 1) {
    next = std::min(history.find('\n', row), history.size() - 1);
    if (!(std::stod(history.substr(row)) < time * (1 - 1e-5))) break;
    end = next;
  }
  return history.substr(0, end - 10);
}

}  // namespace

TEST_CASE("A run that the disk stops keeps a state, from which resume gives what one run gives", "[faults]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  REQUIRE(call_talus(scratch.folder(), run_words("whole")).code == 0);
  for (const int kilobytes : {8, 40, 100}) {
    CAPTURE(kilobytes);
    const std::string out = "full_" + std::to_string(kilobytes);
    Call call = call_within({kilobytes, 0, 0}, scratch.folder(), run_words(out));
    CHECK(call.code == 5);
    CHECK_THAT(call.err, Contains("cannot write '" + out) && Contains("File too large") &&
                             Contains("holds the state at t = ") && Contains("`talus resume` goes on"));
    CHECK_FALSE(has_parts(scratch / out));
    call = call_talus(scratch.folder(), {"resume", out, "--quiet", "--no-report"});
    INFO(call.err);
    REQUIRE(call.code == 0);
    for (const char* file : {"history.csv", "energy.csv", "frames.pvd"})
      CHECK(read_whole_file(scratch / out / file) == read_whole_file(scratch / "whole" / file));
  }
}

TEST_CASE("Words about a kept state are true, also where the disk has no room for it", "[faults]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  std::size_t without = 0;
  for (const int kilobytes : {2, 3, 4, 5, 6, 8}) {
    CAPTURE(kilobytes);
    const std::string out = "full_" + std::to_string(kilobytes);
    std::vector<std::string> words = run_words(out);
    words.insert(words.end(), {"--checkpoint-every", "1e-9"});
    const Call call = call_within({kilobytes, 0, 0}, scratch.folder(), words);
    INFO(call.err);
    CHECK(call.code == 5);
    const bool kept = std::filesystem::exists(scratch / out / "checkpoint.talus");
    CHECK(kept == (call.err.find("holds the state") != std::string::npos));
    without += kept ? 0 : 1;
    if (!kept) continue;
    const Call info = call_talus(scratch.folder(), {"info", out});
    const std::size_t at = info.out.find("t = ");
    REQUIRE(at != std::string::npos);
    CHECK(std::stod(info.out.substr(at + 4)) == Approx(time_of_state(call.err)).epsilon(1e-5));
  }
  CHECK(without > 0);
}

TEST_CASE("Numerical trouble is told where the disk is full as well", "[faults]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  for (const int kilobytes : {3, 4, 8, 0}) {
    CAPTURE(kilobytes);
    const Call call = call_within(
        {kilobytes, 0, 0}, scratch.folder(),
        {"run", "small.json", "--no-report", "--quiet", "--out", std::to_string(kilobytes), "--set",
         "/time/dt=0.1", "--set", "/time/end=20", "--set", "/output/history=1", "--set", "/output/frames=2"});
    INFO(call.err);
    CHECK((call.code == 4 || (call.code == 5 && kilobytes > 0)));
    CHECK_THAT(call.err, Contains("error: the step is too large for the speed at t = 0.2 s"));
  }
}

TEST_CASE("A file that cannot be written whole is not there, nor a part of it", "[faults]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const Call call = call_within({1, 0, 0}, scratch.folder(), run_words("full"));
  CHECK(call.code == 5);
  CHECK_THAT(call.err, Contains("cannot write 'full/resolved.json'") && Contains("File too large"));
  CHECK(std::filesystem::is_empty(scratch / "full"));
}

TEST_CASE("What cannot be printed is an error", "[faults]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  for (const std::vector<std::string>& words : {std::vector<std::string>{"schema"},
                                                {"validate", "small.json"},
                                                {"run", "small.json", "--out", "out"}}) {
    const Call call = call_into("/dev/full", scratch.folder(), words);
    CAPTURE(words, call.err);
    CHECK(call.code == 5);
    CHECK_THAT(call.err, Contains("error: "));
  }
}

TEST_CASE("A folder where nothing can be written is named", "[faults]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  for (const char* folder : {"/proc/talus", "/dev/null/talus"}) {
    const Call call = call_talus(scratch.folder(), {"run", "small.json", "--out", folder});
    CHECK(call.code == 5);
    CHECK_THAT(call.err, Contains(folder));
  }
}

TEST_CASE("A file without an end is not read to its end", "[faults]") {
  const Scratch scratch;
  const Call call = call_within({0, 2000, 60}, scratch.folder(), {"validate", "/dev/zero"});
  CHECK(call.code == 5);
  CHECK_THAT(call.err, Contains("cannot read '/dev/zero'") && Contains("File too large"));
}

TEST_CASE("Results that are cut off or changed after a checkpoint are not continued", "[faults]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  Call call = call_within({40, 0, 0}, scratch.folder(), run_words("full"));
  REQUIRE(call.code == 5);
  const std::filesystem::path history = scratch / "full/history.csv";
  const std::string whole = read_whole_file(history);
  // How early the state is that was kept depends on the clock.
  write_whole_file(history, cut_before(time_of_state(call.err), whole));
  call = call_talus(scratch.folder(), {"resume", "full", "--quiet"});
  CHECK((call.code == 2 || call.code == 5));
  CHECK_THAT(call.err, Contains("history.csv"));
}
