#include "files/whole_file.hpp"
#include "output/scratch.hpp"
#include "program.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using Catch::Matchers::Contains;

TEST_CASE("a picture replaces a file only where it is named", "[apps][view]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  REQUIRE(call_talus(scratch.folder(), {"view", "small.json"}).code == 0);
  scratch.write("small.svg", "mine");
  const Call call = call_talus(scratch.folder(), {"view", "small.json"});
  CHECK(call.code == 2);
  CHECK_THAT(call.err, Contains("'small.svg' is there already: give -o small.svg to replace it"));
  CHECK(read_whole_file(scratch / "small.svg") == "mine");
  REQUIRE(call_talus(scratch.folder(), {"view", "small.json", "-o", "small.svg"}).code == 0);
  CHECK_THAT(read_whole_file(scratch / "small.svg"), Catch::StartsWith("<svg"));
}

TEST_CASE("a picture goes to what standard output is, and takes nothing from it", "[apps][view]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const Call call = call_talus(scratch.folder(), {"view", "small.json", "-o", "/dev/stdout"});
  CHECK(call.code == 0);
  CHECK_THAT(call.out, Catch::StartsWith("<svg") && Catch::EndsWith("</svg>\n/dev/stdout\n"));
}

TEST_CASE("no figures are drawn of a comparison whose record is damaged", "[apps][view][report]") {
  const Scratch scratch;
  scratch.write("compare.json", R"({"varied": "/title"})");
  for (const char* command : {"view", "report"}) {
    const Call call = call_talus(scratch.folder(), {command, "."});
    CHECK(call.code == 2);
    CHECK_THAT(call.err, Contains("compare.json' is no record of a comparison: its /runs is missing"));
  }
  CHECK_FALSE(std::filesystem::exists(scratch / "figures"));
}
