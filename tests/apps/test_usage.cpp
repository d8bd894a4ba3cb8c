#include "output/scratch.hpp"
#include "program.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using Catch::Matchers::Contains;

TEST_CASE("help and version go to stdout", "[apps]") {
  const Scratch scratch;
  const Call help = call_talus(scratch.folder(), {"--help"});
  CHECK(help.code == 0);
  CHECK_THAT(help.out,
             Contains("compare") && Contains("Examples") && Contains("130") && Contains("out/<scene name>"));
  CHECK(help.err.empty());
  const Call version = call_talus(scratch.folder(), {"--version"});
  CHECK(version.code == 0);
  CHECK(version.out == "talus " TALUS_VERSION "\n");
  for (const char* command : {"run", "compare", "validate", "blocks", "plugins", "describe", "check-plugin",
                              "new-plugin", "schema"}) {
    const Call call = call_talus(scratch.folder(), {command, "--help"});
    CHECK(call.code == 0);
    CHECK_THAT(call.out, Contains(std::string("Usage: talus ") + command) && Contains("--plugin-path"));
  }
}

TEST_CASE("a word that is no command or option gets the nearest one", "[apps]") {
  const Scratch scratch;
  const Call command = call_talus(scratch.folder(), {"compere"});
  CHECK(command.code == 2);
  CHECK_THAT(command.err, Contains("unknown command 'compere'") && Contains("did you mean 'compare'?"));
  CHECK(command.out.empty());
  const Call option = call_talus(scratch.folder(), {"run", "scene.json", "--overwrit"});
  CHECK(option.code == 2);
  CHECK_THAT(option.err, Contains("unknown option '--overwrit'") && Contains("'--overwrite'"));
  const Call other = call_talus(scratch.folder(), {"run", "scene.json", "--nope"});
  CHECK_THAT(other.err, Contains("unknown option '--nope'") && !Contains("did you mean"));
  CHECK(call_talus(scratch.folder(), {"--versoin"}).code == 2);
  CHECK_THAT(call_talus(scratch.folder(), {"--vers"}).err, Contains("did you mean '--version'?"));
  CHECK(call_talus(scratch.folder(), {}).code == 2);
}

TEST_CASE("arguments that are missing, too many or senseless are told", "[apps]") {
  const Scratch scratch;
  const auto refused = [&](const std::vector<std::string>& words) {
    const Call call = call_talus(scratch.folder(), words);
    CHECK(call.code == 2);
    CHECK(call.out.empty());
    return call.err;
  };
  CHECK_THAT(refused({"run"}), Contains("SCENE is missing"));
  CHECK_THAT(refused({"run", "a.json", "b.json"}), Contains("one SCENE only"));
  CHECK_THAT(refused({"run", "a.json", "--threads", "many"}), Contains("--threads"));
  for (const char* threads : {"0", "abc", "2x", "99999999999"})
    CHECK_THAT(refused({"run", "a.json", "--threads", threads}),
               Contains(std::string("--threads ") + threads + ": allowed are 1 to 1024"));
  CHECK_THAT(refused({"run", "a.json", "--simd", "sse9"}), Contains("--simd sse9") && Contains("avx512"));
  CHECK_THAT(refused({"run", "a.json", "--set", "time=1"}), Contains("--set /pointer=value"));
  CHECK_THAT(refused({"run", "a.json", "--plugin-path", "nowhere"}), Contains("nowhere"));
  CHECK_THAT(refused({"compare", "a.json"}), Contains("--vary"));
  CHECK_THAT(refused({"compare", "a.json", "--vary", "/contact/model"}), Contains("/pointer=value"));
}

TEST_CASE("plugins and describe read the descriptors", "[apps]") {
  const Scratch scratch;
  const Call plugins = call_talus(scratch.folder(), {"plugins"});
  CHECK(plugins.code == 0);
  CHECK_THAT(plugins.out, Contains("overlap_area") && Contains("vertex_edge") && Contains("linear_elastic") &&
                              Contains("contact law"));
  const Call law = call_talus(scratch.folder(), {"describe", "overlap_area"});
  CHECK(law.code == 0);
  CHECK_THAT(law.out, Contains("friction_rule") && Contains("return_mapping") &&
                          Contains("normal_stiffness") && Contains("Pa/m") && Contains("required"));
  CHECK_THAT(call_talus(scratch.folder(), {"describe", "/time"}).out, Contains("safety") && Contains("0.2"));
  for (const char* ramp :
       {"/prescribed/0/ramp", "/stages/1/set/~1prescribed~10~1ramp", "/stages/1/set/~1prescribed/0/ramp"})
    CHECK_THAT(call_talus(scratch.folder(), {"describe", ramp}).out, Contains("grows to its full size"));
  const Call unknown = call_talus(scratch.folder(), {"describe", "overlap_aera"});
  CHECK(unknown.code == 2);
  CHECK_THAT(unknown.err, Contains("did you mean 'overlap_area'?"));
}

TEST_CASE("values of options that make no sense are refused with what would", "[apps]") {
  const Scratch scratch;
  scratch.write("scene.json", small_scene());
  std::filesystem::create_directory(scratch / "folder");
  const struct {
    std::vector<std::string> words;
    const char* said;
  } mistaken[] = {
      {{"advise", "scene.json"}, "--error 1% is missing"},
      {{"advise", "scene.json", "--error", "little"},
       "--error little: give a share above 0, at most 1: 1% or 0.01"},
      {{"advise", "scene.json", "--error", "-1%"}, "--error -1%: give a share above 0"},
      {{"advise", "scene.json", "--error", "5"}, "--error 5: give a share above 0, at most 1"},
      {{"run", "scene.json", "--out", ""}, "--out is empty"},
      {{"advise", "scene.json", "--error", "1%%"}, "--error 1%%: give a share above 0"},
      {{"help", "run", "--man"}, "the manual page holds all commands: give --man alone"},
      {{"run", "scene.json", "--wall-time", "-1"}, "--wall-time -1: give seconds, 0 or more"},
      {{"run", "scene.json", "--wall-time", "nan"}, "give seconds, 0 or more"},
      {{"run", "scene.json", "--set", "time/end=1"}, "--set time/end=1: write it as --set /pointer=value"},
      {{"compare", "scene.json", "--vary", "/time"}, "--vary /time: write it as --vary /pointer=value,value"},
      {{"blocks", "scene.json", "-o", "folder"}, "'folder' is a folder: name a file"},
      {{"view", "scene.json", "-o", "folder"}, "'folder' is a folder: name a file"},
      {{"view", "folder", "-o", "a.svg"}, "-o and --set are for scenes"}};
  for (const auto& [words, said] : mistaken) {
    const Call call = call_talus(scratch.folder(), words);
    CAPTURE(words, call.err);
    CHECK(call.code == 2);
    CHECK_THAT(call.err, Contains(said));
    CHECK_FALSE(std::filesystem::exists(scratch / "a.svg"));
    CHECK_FALSE(std::filesystem::exists(scratch / "out"));
  }
}
