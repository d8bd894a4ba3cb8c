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

TEST_CASE("figures go with the results that they are of", "[apps][view]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const std::vector<std::string> run{"run", "small.json", "--quiet", "--out", "out", "--overwrite"};
  REQUIRE(call_talus(scratch.folder(), run).code == 0);
  REQUIRE(call_talus(scratch.folder(), {"view", "out"}).code == 0);
  REQUIRE(std::filesystem::exists(scratch / "out/figures/energy.svg"));
  scratch.write("out/figures/energy_by_hand.svg", "mine");
  REQUIRE(call_talus(scratch.folder(), run).code == 0);
  REQUIRE(std::filesystem::exists(scratch / "out/figures"));
  CHECK(std::distance(std::filesystem::directory_iterator(scratch / "out/figures"), {}) == 1);
  CHECK(read_whole_file(scratch / "out/figures/energy_by_hand.svg") == "mine");

  const std::string long_title(300, 't');
  const std::vector<std::string> compare{"compare",     "small.json", "--out",  "c",
                                         "--overwrite", "--quiet",    "--vary", "/title=a b," + long_title};
  const Call compared = call_talus(scratch.folder(), compare);
  INFO(compared.err);
  REQUIRE(compared.code == 0);
  const Call viewed = call_talus(scratch.folder(), {"view", "c"});
  INFO(viewed.err);
  REQUIRE(viewed.code == 0);
  CHECK_THAT(viewed.out, Contains("energy_a_b.svg") && Contains("last_state_ttt"));
  REQUIRE(call_talus(scratch.folder(), compare).code == 0);
  CHECK_FALSE(std::filesystem::exists(scratch / "c/figures"));
}
