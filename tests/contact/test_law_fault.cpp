#include "apps/program.hpp"
#include "output/scratch.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using Catch::Contains;

namespace {

Call run_under(const std::string& law) {
  const Scratch scratch;
  scratch.write("scene.json", small_scene());
  return call_talus(scratch.folder(), {"run", "scene.json", "--plugin-path", TALUS_TEST_LIBRARIES, "--set",
                                       "/contact/model=" + law});
}

}  // namespace

TEST_CASE("A run stops with words when a law breaks the rules of loads", "[contact]") {
  const auto trouble_of = [](const std::string& law) {
    INFO(law);
    const Call call = run_under(law);
    CHECK(call.code == 4);
    CHECK_THAT(call.err, Contains("libmisbehaving.so: contact law '" + law + "' gave ") &&
                             Contains("t = 0 s") && Contains("wanted finite loads") &&
                             Contains("mend the law"));
    return call.err;
  };
  CHECK_THAT(trouble_of("nan_load"),
             Contains("a load that is no number between 'slab' at") && Contains("'block' at"));
  CHECK_THAT(trouble_of("nan_report"), Contains("a report that is no number between"));
  CHECK_THAT(trouble_of("nan_dashpot"), Contains("a report that is no number between"));
  CHECK_THAT(trouble_of("nan_contact"), Contains("a contact report that is no number between"));
  CHECK_THAT(trouble_of("past_the_end"), Contains("a load written past the last corner of all pairs"));
  CHECK_THAT(trouble_of("one_sided"), Contains("leave a force of 1 N/m over, of 1 between"));
  CHECK_THAT(trouble_of("couple"), Contains("leave a moment of 1 N over"));
}

TEST_CASE("A law that says contacts hold less energy than none stops the run and is named", "[contact]") {
  const Call call = run_under("debt");
  CHECK(call.code == 4);
  CHECK_THAT(call.err, Contains("libmisbehaving.so: contact law 'debt' gave a stored energy of -1 J/m") &&
                           Contains("mend the law or choose another"));
}

TEST_CASE("What a law throws where it may not is told before the program is aborted", "[contact]") {
  const Call call = run_under("throws");
  CHECK(call.code == 134);
  CHECK_THAT(call.err, Contains("'no such pair' was thrown where nothing may be"));
}

TEST_CASE("A law that prepares an interface by what is no number is refused with the parameter",
          "[contact]") {
  const Call call = run_under("nan_interface");
  CHECK(call.code == 3);
  CHECK_THAT(call.err,
             Contains("libmisbehaving.so: contact law 'nan_interface' prepared nan from 'strength'"));
}
