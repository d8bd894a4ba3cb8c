#include "apps/program.hpp"
#include "output/scratch.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using Catch::Matchers::Contains;

TEST_CASE("describe tells the defaults of a section: automatic, not set, required or a number", "[scene]") {
  const Scratch scratch;
  const std::string time = call_talus(scratch.folder(), {"describe", "/time"}).out;
  CHECK_THAT(time, Catch::Matches(R"([\s\S]*dt +s +"auto" +> 0, [\s\S]*)"));
  CHECK_THAT(time, Catch::Matches(R"([\s\S]*end +s +required +> 0 [\s\S]*)"));
  CHECK_THAT(time, !Contains("not set"));
  CHECK_THAT(call_talus(scratch.folder(), {"describe", "/output"}).out,
             Catch::Matches(R"([\s\S]*frames +s +not set +> 0 [\s\S]*)"));
}
