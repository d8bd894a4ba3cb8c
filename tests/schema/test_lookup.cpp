#include "apps/program.hpp"
#include "output/scratch.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using Catch::Matchers::Contains;

namespace {

std::string described(const std::string& name) {
  const Scratch scratch;
  const Call call = call_talus(scratch.folder(), {"describe", name});
  CHECK(call.code == 0);
  return call.out;
}

}  // namespace

TEST_CASE("describe takes pointers as messages have them", "[schema]") {
  for (const char* pointer : {"/bodies/velocity", "/bodies/*/velocity", "/bodies/3/velocity"}) {
    const std::string velocity = described(pointer);
    CHECK_THAT(velocity, Contains("A key of /bodies/*\n") && Contains("m/s") && Contains("at the start"));
    CHECK_THAT(velocity, !Contains("polygon"));
  }
  for (const char* pointer : {"/bodies", "/bodies/*", "/bodies/3"})
    CHECK_THAT(described(pointer), Contains("/bodies/* (section of a scene)") && Contains("polygon"));
  CHECK_THAT(described("/bodies/3/drive"), Contains("/bodies/*/drive (section of a scene)"));
  CHECK_THAT(described("/gravity"), Contains("A key of /\n") && Contains("m/s2"));
  CHECK_THAT(described("/time/end"), Contains("A key of /time\n") && !Contains("safety"));
  CHECK_THAT(described("/contact/overlap_area/friction_rule"),
             Contains("A key of /contact/overlap_area\n") && !Contains("cohesive"));
  CHECK_THAT(described("/contact/overlap_area"),
             Contains("overlap_area (contact law") && Contains("Parameters"));
  for (const char* pointer : {"/bodies/1/cover/size", "/blocks/0/cover/size", "/cover/size"})
    CHECK_THAT(described(pointer), Contains("A key of /cover of hexagonal\n"));
}

TEST_CASE("describe finds a key by its name, those of components among them", "[schema]") {
  const std::string angle = described("friction_angle");
  CHECK_THAT(angle, Contains("A key of /interfaces/*\n"));
  CHECK_THAT(angle, Contains("A key of /materials/* of mohr_coulomb\n"));
  const std::string of_interfaces = described("/interfaces/0/friction_angle");
  CHECK_THAT(of_interfaces, Contains("A key of /interfaces/*\n") && !Contains("mohr_coulomb"));
  CHECK_THAT(described("/materials/rock/young_modulus"), Contains("linear_elastic") && !Contains("(section"));
}

TEST_CASE("describe guesses a key among those beside it", "[schema]") {
  const Scratch scratch;
  const Call call = call_talus(scratch.folder(), {"describe", "/time/ned"});
  CHECK(call.code == 2);
  CHECK_THAT(call.err,
             Contains("did you mean '/time/end'?") && Contains("/time/safety") && !Contains("/sleep"));
  const Call law = call_talus(scratch.folder(), {"describe", "/contact/overlap_area/friction_rul"});
  CHECK(law.code == 2);
  CHECK_THAT(law.err,
             Contains("did you mean '/contact/overlap_area/friction_rule'?") && !Contains("calibration"));
}
