#include "files/whole_file.hpp"
#include "installation.hpp"
#include "output/scratch.hpp"
#include "program.hpp"

#include <catch2/catch.hpp>

#include <filesystem>
#include <regex>
#include <sstream>

using namespace talus;
using Catch::Matchers::Contains;

namespace {

/// What bash offers for the last of these words.
std::vector<std::string> offered(const Scratch& scratch, const std::vector<std::string>& words) {
  const Call script = call_talus(scratch.folder(), {"completion", "bash"});
  REQUIRE(script.code == 0);
  std::string line = "COMP_WORDS=(talus";
  for (const std::string& word : words) line += " '" + word + "'";
  scratch.write("complete.bash", script.out + line + "); COMP_CWORD=" + std::to_string(words.size()) +
                                     "; _talus; printf '%s\\n' \"${COMPREPLY[@]}\"\n");
  const Call call = call_program("/bin/bash", scratch.folder(), {"--norc", "complete.bash"});
  CHECK(call.code == 0);
  CHECK(call.err.empty());
  std::istringstream lines(call.out);
  std::vector<std::string> all;
  for (std::string one; std::getline(lines, one);) {
    if (!one.empty()) all.push_back(one);
  }
  return all;
}

using Offered = std::vector<std::string>;

}  // namespace

TEST_CASE("bash completes commands, options, their values and files", "[apps][shell]") {
  const Scratch scratch;
  scratch.write("slope.json", "{}");
  scratch.write("slope.txt", "");
  std::filesystem::create_directory(scratch / "slopes");
  CHECK(offered(scratch, {"comp"}) == Offered{"compare", "completion"});
  CHECK(offered(scratch, {"--v"}) == Offered{"--version"});
  CHECK(offered(scratch, {"run", "--ov"}) == Offered{"--overwrite"});
  CHECK(offered(scratch, {"compare", "--va"}) == Offered{"--vary"});
  CHECK(offered(scratch, {"run", "--va"}).empty());
  CHECK(offered(scratch, {"run", "--simd", "avx"}) == Offered{"avx2", "avx512"});
  CHECK(offered(scratch, {"run", "--simd", "=", "s"}) == Offered{"scalar"});
  CHECK(offered(scratch, {"run", "slo"}) == Offered{"slopes", "slope.json"});
  CHECK(offered(scratch, {"run", "--out", "slo"}) == Offered{"slopes"});
  CHECK(offered(scratch, {"run", "-o", "slo"}) == Offered{"slopes"});
  CHECK(offered(scratch, {"blocks", "-o", "slope.t"}) == Offered{"slope.txt"});
  CHECK(offered(scratch, {"help", "vali"}) == Offered{"validate"});
  CHECK(offered(scratch, {"completion", ""}) == Offered{"bash"});
  CHECK(offered(scratch, {"nothing", ""}).empty());
}

TEST_CASE("completion knows bash alone", "[apps][shell]") {
  const Scratch scratch;
  const Call call = call_talus(scratch.folder(), {"completion", "fish"});
  CHECK(call.code == 2);
  CHECK_THAT(call.err, Contains("SHELL fish") && Contains("bash alone"));
}

TEST_CASE("help COMMAND prints what COMMAND --help prints, and guesses at misspelt commands", "[apps]") {
  const Scratch scratch;
  CHECK(call_talus(scratch.folder(), {"help", "run"}).out ==
        call_talus(scratch.folder(), {"run", "--help"}).out);
  CHECK(call_talus(scratch.folder(), {"help"}).out == call_talus(scratch.folder(), {"--help"}).out);
  const Call call = call_talus(scratch.folder(), {"help", "rum"});
  CHECK(call.code == 2);
  CHECK_THAT(call.err, Contains("did you mean 'run'?"));
  CHECK(call_talus(scratch.folder(), {"help", "run", "--man"}).code == 2);
}

TEST_CASE("the manual holds every command and option and is good roff", "[apps][shell]") {
  const Scratch scratch;
  const Call manual = call_talus(scratch.folder(), {"help", "--man"});
  REQUIRE(manual.code == 0);
  CHECK_THAT(manual.out, Catch::StartsWith(".TH TALUS 1 ") && Contains(".SS compare\n") &&
                             Contains("\\-\\-checkpoint\\-every") && Contains(".SH EXIT STATUS") &&
                             Contains("NO_COLOR"));
  scratch.write("talus.1", manual.out);
  const std::string checks =
      "if command -v groff; then groff -man -ww -Tutf8 talus.1 > shown.txt || exit 1; fi >&2\n"
      "if command -v mandoc > /dev/null; then mandoc -Tlint -W warning talus.1 || exit 1; fi\n";
  scratch.write("check.sh", "exec 2>&1\n" + checks);
  const Call call = call_program("/bin/sh", scratch.folder(), {"check.sh"});
  INFO(call.out);
  CHECK(call.code == 0);
  CHECK_THAT(call.out, !Contains("warning") && !Contains("WARNING") && !Contains("ERROR"));
}

TEST_CASE("completion and manual are installed as the program writes them", "[apps][shell]") {
  const Installation installed;
  CHECK(read_whole_file(installed.prefix() / "share/bash-completion/completions/talus") ==
        installed.talus({"completion", "bash"}).out);
  CHECK(read_whole_file(installed.prefix() / "share/man/man1/talus.1") ==
        installed.talus({"help", "--man"}).out);
}

TEST_CASE("installed documents find all they refer to", "[apps][shell]") {
  const Installation installed;
  const std::filesystem::path documents = installed.prefix() / "share/doc/talus";
  const std::regex link("\\]\\(([^)#\\s]+)");
  int links = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(documents)) {
    if (entry.path().extension() != ".md") continue;
    const std::string text = read_whole_file(entry.path());
    for (std::sregex_iterator at(text.begin(), text.end(), link), end; at != end; ++at) {
      const std::string target = (*at)[1];
      if (target.starts_with("http")) continue;
      ++links;
      INFO(entry.path().string() << " refers to " << target);
      CHECK(std::filesystem::exists(entry.path().parent_path() / target));
    }
  }
  CHECK(links > 50);
}

TEST_CASE("a run outlives who reads its log", "[apps][shell][run]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  call_program("/bin/bash", scratch.folder(),
               {"--norc", "-c", "'" TALUS_PROGRAM "' run small.json --out piped 2>&1 | head -n 1"});
  CHECK(json_of(scratch / "piped/run.json")["end"] == "finished");
}
