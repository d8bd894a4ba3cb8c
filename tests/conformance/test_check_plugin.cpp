#include "apps/program.hpp"
#include "files/whole_file.hpp"
#include "output/scratch.hpp"

#include <catch2/catch.hpp>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <filesystem>
#include <sstream>

using namespace talus;
using Catch::Matchers::Contains;

namespace {

std::string spoilt(const std::string& stem) {
  return TALUS_TEST_LIBRARIES "/conformance/lib" + stem + ".so";
}

/// Names of the checks with a verdict, in order.
std::vector<std::string> checks_with(const std::string& verdict, const std::string& report) {
  std::vector<std::string> names;
  std::istringstream lines(report);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  " + verdict + " ")) continue;
    std::istringstream words(line.substr(2 + verdict.size()));
    words >> names.emplace_back();
  }
  return names;
}

using Names = std::vector<std::string>;

struct Wrong {
  const char* library;
  Names checks;
};

void expect_failures(const std::vector<Wrong>& wrong) {
  const Scratch scratch;
  for (const Wrong& one : wrong) {
    const Call call = call_talus(scratch.folder(), {"check-plugin", spoilt(one.library)});
    INFO(call.out << call.err);
    CHECK(call.code == 1);
    CHECK(checks_with("FAILED", call.out) == one.checks);
    CHECK_THAT(call.out,
               Contains("\n      fed    ") && Contains("\n      found  ") && Contains("\n      due    "));
  }
}

}  // namespace

TEST_CASE("the components that ship keep to what is due of them", "[conformance][slow_sanitised]") {
  struct Shipped {
    const char* name;
    Names not_claimed;
  };
  const Shipped shipped[] = {{"overlap_area", {}},
                             {"vertex_edge", {"potential", "plan"}},
                             {"frictionless", {"friction", "plan"}},
                             {"feng_volume", {"friction", "plan"}},
                             {"cohesive_overlap", {"plan"}},
                             {"potential_symmetric", {"friction", "plan"}},
                             {"linear_elastic", {}},
                             {"hypoelastic", {"potential", "sweep"}},
                             {"mohr_coulomb", {"potential", "sweep"}},
                             {"block", {"boundary"}},
                             {"rigid", {"area", "unity", "affine", "boundary"}},
                             {"hexagonal", {}},
                             {"mesh", {}}};
  const Scratch scratch;
  for (const Shipped& one : shipped) {
    const Call call = call_talus(scratch.folder(), {"check-plugin", one.name});
    INFO(call.out << call.err);
    CHECK(call.code == 0);
    CHECK(checks_with("FAILED", call.out) == Names{});
    CHECK(checks_with("not claimed", call.out) == one.not_claimed);
    CHECK(checks_with("passed", call.out).size() >= 3);
  }
}

TEST_CASE("check-plugin passes a right law, material and cover in each of their checks",
          "[conformance][slow_sanitised]") {
  const Scratch scratch;
  for (const auto& [library, checks] :
       {std::pair{"right", 26}, std::pair{"right_damped", 25}, std::pair{"right_rock", 11},
        std::pair{"right_neo_rock", 11}, std::pair{"right_viscous_rock", 11}, std::pair{"right_fan", 7}}) {
    const Call right = call_talus(scratch.folder(), {"check-plugin", spoilt(library)});
    INFO(right.out << right.err);
    CHECK(right.code == 0);
    CHECK(checks_with("passed", right.out).size() == static_cast<std::size_t>(checks));
  }
}

TEST_CASE("a law that favours, depends or pulls fails in the one check that is meant for it",
          "[conformance][slow_sanitised]") {
  expect_failures({{"attracts", {"gap"}},
                   {"depends_on_order", {"order"}},
                   {"depends_on_place", {"translation"}},
                   {"drags", {"galilean"}},
                   {"exceeds_friction", {"friction"}},
                   {"forgets_at_joints", {"joint"}},
                   {"favours_a_hand", {"reflection"}},
                   {"favours_an_axis", {"rotation"}},
                   {"ignores_friction", {"friction"}},
                   {"knows_one_interface", {"interfaces"}},
                   {"lets_go", {"friction"}},
                   {"lies_about_gaps", {"gap"}},
                   {"loses_moment", {"balance"}},
                   {"pulls", {"tension"}},
                   {"rubs_forward", {"friction"}},
                   {"tells_slip_wrong", {"friction"}},
                   {"stiffens_while_bonds_form", {"settling"}},
                   {"stiffens_while_held", {"settling"}}});
}

TEST_CASE("a law that is wrong about energy or stiffness fails in the one check that is meant for it",
          "[conformance][slow_sanitised]") {
  expect_failures({{"books_as_both", {"account"}},
                   {"books_no_damping", {"account"}},
                   {"books_no_loss", {"account"}},
                   {"hides_dashpots", {"account"}},
                   {"overstates_damping", {"account"}},
                   {"has_no_potential", {"potential"}},
                   {"kicks_at_joints", {"joint"}},
                   {"knows_one_step", {"account"}},
                   {"lends_to_friction", {"account"}},
                   {"stores_at_once", {"account"}},
                   {"understates_depth", {"reports"}},
                   {"wrong_unit", {"stiffness"}}});
}

TEST_CASE("a law that makes energy fails where it books that as friction, too",
          "[conformance][slow_sanitised]") {
  expect_failures(
      {{"creates_energy", {"account", {"cycles"}}}, {"gains_as_master", {"account", {"cycles"}}}});
}

TEST_CASE("a law that does not keep to the interface fails in the one check that is meant for it",
          "[conformance][slow_sanitised]") {
  expect_failures({{"breaks_on_short_sides", {"degenerate"}},
                   {"clings_to_plan", {"plan"}},
                   {"crashes", {"degenerate"}},
                   {"depends_on_batch", {"split"}},
                   {"divides_by_step", {"degenerate"}},
                   {"ignores_reset", {"reset"}},
                   {"loads_cuts", {"strips"}},
                   {"mistakes_bodies", {"split"}},
                   {"prepares_too_much", {"writes"}},
                   {"reads_past", {"reads"}},
                   {"refuses_without_words", {"parameters"}},
                   {"remembers", {"restore"}},
                   {"writes_past", {"writes"}}});
}

TEST_CASE("a material that is wrong fails in the one check that is meant for it", "[conformance]") {
  expect_failures({{"denies_viscosity", {"losses"}},
                   {"falls_back", {"tangent"}},
                   {"ignores_rotation", {"objectivity"}},
                   {"invents_viscosity", {"losses"}},
                   {"keeps_too_much", {"parameters"}},
                   {"loses_viscous_work", {"power"}},
                   {"never_relaxes", {"tangent"}},
                   {"slow_waves", {"tangent"}},
                   {"stores_double", {"power"}},
                   {"sweeps_otherwise", {"sweep"}},
                   {"works_in_eights", {"writes"}}});
}

TEST_CASE("a cover that is wrong fails in the one check that is meant for it", "[conformance]") {
  expect_failures({{"empty_element", {"count"}},
                   {"idle_patch", {"count"}},
                   {"loses_area", {"area"}},
                   {"names_wrong_sides", {"boundary"}},
                   {"refuses_in_silence", {"taken"}},
                   {"scales_strain", {"count"}},
                   {"steadies_askew", {"affine"}},
                   {"steadies_itself", {"count"}},
                   {"torn", {"unity"}},
                   {"turns_round", {"count"}}});
}

TEST_CASE("a law that does not come back is stopped and fails where it hung",
          "[conformance][slow_sanitised]") {
  const Scratch scratch;
  const Call call = call_talus(scratch.folder(), {"check-plugin", spoilt("hangs"), "--time-limit", "6"});
  INFO(call.out << call.err);
  CHECK(call.code == 1);
  CHECK(checks_with("FAILED", call.out) == Names{"degenerate"});
  CHECK_THAT(call.out, Contains("a corner at x = nan m") && Contains("no answer after 6 s"));
}

TEST_CASE("what a law throws where nothing may be is told once, in the check that it ended",
          "[conformance][slow_sanitised]") {
  const Scratch scratch;
  const Call call = call_talus(scratch.folder(), {"check-plugin", spoilt("throws_within")});
  INFO(call.out << call.err);
  CHECK(call.code == 1);
  CHECK(checks_with("FAILED", call.out) == Names{"degenerate"});
  CHECK_THAT(call.out, Contains("'no place for this corner' thrown where nothing may be"));
  CHECK_THAT(call.err, !Contains("no place for this corner"));
}

TEST_CASE("a report goes to JUnit and to a page, with what was fed, found and due",
          "[conformance][slow_sanitised]") {
  const Scratch scratch;
  const Call call = call_talus(scratch.folder(), {"check-plugin", spoilt("exceeds_friction"), "--junit",
                                                  "report.xml", "--html", "report.html"});
  CHECK(call.code == 1);
  const std::string junit = read_whole_file(scratch.folder() / "report.xml");
  boost::property_tree::ptree tree;
  std::istringstream stream(junit);
  REQUIRE_NOTHROW(boost::property_tree::read_xml(stream, tree));
  CHECK(tree.get<int>("testsuites.<xmlattr>.failures") == 1);
  const auto& suite = tree.get_child("testsuites.testsuite");
  CHECK(suite.get<std::string>("<xmlattr>.name") == "exceeds_friction");
  CHECK(static_cast<std::size_t>(suite.get<int>("<xmlattr>.tests")) == suite.count("testcase"));
  std::string failure;
  for (const auto& [name, test] : suite) {
    if (name == "testcase" && test.count("failure") > 0) {
      CHECK(test.get<std::string>("<xmlattr>.name") == "friction");
      failure = test.get<std::string>("failure");
    }
  }
  CHECK_THAT(failure, Contains("fed: a block 1 mm deep") && Contains("found: force along the base") &&
                          Contains("due: at most"));
  const std::string page = read_whole_file(scratch.folder() / "report.html");
  CHECK_THAT(page, Contains("<td class=\"failed\">FAILED</td><td><code>friction</code>") &&
                       Contains("|T| &lt;= μ P") && Contains("found</dt>"));
  CHECK_THAT(page, !Contains("src=") && !Contains("href=\"http"));
}

TEST_CASE("a library that is refused, or does not survive being loaded, has exit code 3", "[conformance]") {
  const Scratch scratch;
  const auto refused = [&](const std::string& file) {
    const Call call = call_talus(scratch.folder(), {"check-plugin", file});
    CHECK(call.code == 3);
    CHECK(call.out.empty());
    return call.err;
  };
  CHECK_THAT(refused(TALUS_TEST_LIBRARIES "/libwrong_units.so"),
             Contains("found the unit system 'SI: mm t s"));
  CHECK_THAT(refused(spoilt("crashes_when_loaded")),
             Contains("found a crash: signal 4") && Contains("while it was loaded"));
  CHECK_THAT(refused(spoilt("throws_when_loaded")), Contains("found static objects that throw"));
  CHECK_THAT(refused("./nowhere.so"), Contains("found no such file"));
}

TEST_CASE("A library that throws while it is loaded ends the command that loads it, by name", "[plugin]") {
  const Scratch scratch;
  std::filesystem::create_directory(scratch / "plugins");
  std::filesystem::copy_file(spoilt("throws_when_loaded"), scratch / "plugins/libthrows.so");
  const Call call = call_talus(scratch.folder(), {"plugins", "--plugin-path", "plugins"});
  CHECK(call.code == 3);
  CHECK_THAT(call.err, Contains("plugins/libthrows.so: found static objects that throw while it is loaded"));
}

TEST_CASE("check-plugin tells what is wrong with its words", "[conformance]") {
  const Scratch scratch;
  const auto words_of = [&](const std::vector<std::string>& words) {
    const Call call = call_talus(scratch.folder(), words);
    CHECK(call.code == 2);
    CHECK(call.out.empty());
    return call.err;
  };
  CHECK_THAT(words_of({"check-plugin"}), Contains("LIB is missing"));
  CHECK_THAT(words_of({"check-plugin", "overlap_aera"}), Contains("did you mean 'overlap_area'?"));
  CHECK_THAT(words_of({"check-plugin", "overlap_area", "--time-limit", "0"}), Contains("--time-limit 0"));
}
