// Plugins built outside the tree, against an installed talus alone, as a stranger would.
#include "apps/installation.hpp"
#include "plugin/descriptors.hpp"

#include <catch2/catch.hpp>
#include <talus/testing/two_bodies.hpp>

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include <cstdlib>

using namespace talus;
using Catch::Contains;

namespace fs = std::filesystem;

namespace {

/// A unit square (body a) and a square on its tip (body b), whose lowest corner is `depth` below the top of
/// the first, at a quarter of its width.
testing::Outcome pushed(const ContactModel& law, double depth) {
  testing::TwoBodies squares({{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                             {{0.25, 1 - depth}, {1.25, 2 - depth}, {0.25, 3 - depth}, {-0.75, 2 - depth}});
  return squares.evaluate(law, {3e6});
}

/// State after a tenth of a second on the incline with the overlap-area law of a folder, or the built-in one.
std::string state_with(const Installation& installed, const std::string& folder) {
  std::vector<std::string> words{"run",   "scenes/incline.json", "--quiet",
                                 "--set", "/time/end=0.1",       "--overwrite"};
  if (!folder.empty()) {
    words.insert(words.end(), {"--plugin-path", folder});
    const Call described = installed.talus({"plugins", "--plugin-path", folder});
    CHECK_THAT(described.out, Contains((installed.work() / folder / "liboverlap_area.so\n").string()));
  }
  const Call call = installed.talus(words);
  INFO(call.err);
  REQUIRE(call.code == 0);
  return json_of(installed.work() / "out" / "incline" / "run.json").at("state_hash");
}

}  // namespace

TEST_CASE("A law built outside the tree loads and pushes", "[plugin]") {
  const Installation installed;
  const bool levels = fs::exists(fs::path(TALUS_PLUGINS) / "avx512" / "liboverlap_area.so");
  const Call build =
      installed.shell(fmt::format("'{0}' -S '{1}' -B build -G Ninja {2} && '{0}' --build build", TALUS_CMAKE,
                                  TALUS_OUTSIDE, levels ? "" : "-DTALUS_SIMD=OFF"));
  INFO(build.out << build.err);
  REQUIRE(build.code == 0);
  Registry registry;
  load_library(registry, installed.work() / "build" / "libsoft_corner.so");
  const RegisteredComponent* entry = registry.find(ComponentKind::contact_model, "soft_corner");
  REQUIRE(entry != nullptr);
  CHECK(std::string(entry->library->author) == "somebody else");
  CHECK(std::string(entry->component->interface_parameters[0].key) == "normal_stiffness");
  CHECK(fs::exists(installed.work() / "build" / "avx512" / "libsoft_corner.so") == levels);
  CHECK_THAT(installed.talus({"plugins", "--plugin-path", "build"}).out,
             Contains("soft_corner 1.0 by somebody else"));

  const auto law = make<ContactModel>(*entry, {});
  CHECK(law->doubles_per_contact() == 0);
  const testing::Outcome outcome = pushed(*law, 0.1);
  CHECK(outcome.report.contact_count == 1);
  CHECK(outcome.report.penetration == Approx(0.1));
  CHECK(outcome.contacts[0].py == Approx(3e6 * 0.01));
  CHECK(outcome.loads[4].y == Approx(3e4));          // the lowest corner of b goes up
  CHECK(outcome.loads[2].y == Approx(-3e4 * 0.25));  // the ends of a's top side bear it, the nearer one more
  CHECK(outcome.loads[3].y == Approx(-3e4 * 0.75));
  CHECK(std::abs(outcome.net.x) < 1e-8);
  CHECK(std::abs(outcome.net.y) < 1e-8);
  CHECK(std::abs(outcome.net_moment) < 1e-8);
  CHECK((pushed(*law, 0.1 + 1e-6).report.stored - pushed(*law, 0.1 - 1e-6).report.stored) / 2e-6 ==
        Approx(3e4));
}

TEST_CASE("A plugin of another compiler, level and machine flag gives the same bits", "[plugin]") {
  const Installation installed;
  const std::string built_in = state_with(installed, "");
  struct Build {
    const char *compiler, *flags, *folder;
  };
  for (const Build& build : {Build{"clang++", "-O0", "clang"}, Build{"c++", "-O1 -march=native", "native"}}) {
    if (!has_compiler(build.compiler)) {
      WARN(build.compiler << " is not installed: a plugin built by it is not tested");
      continue;
    }
    INFO(build.compiler << ' ' << build.flags);
    build_plugin(build.compiler, build.flags, installed.prefix() / "include", TALUS_LAW_SOURCE,
                 installed.work() / build.folder / "liboverlap_area.so");
    CHECK(state_with(installed, build.folder) == built_in);
  }
}

TEST_CASE("An installed program is whole wherever its prefix is moved", "[plugin]") {
  const Installation installed;
  const fs::path moved = installed.work() / "elsewhere";
  fs::rename(installed.prefix(), moved);
  const Call run = call_program(moved / "bin" / "talus", installed.work(), {"run", "scenes/collision.json"});
  CHECK(run.code == 0);
  CHECK_THAT(run.err, Contains("there is no scenes/collision.json here: taking " +
                               (moved / "share/talus/scenes/collision.json").string()));
  CHECK(fs::exists(installed.work() / "out" / "collision" / "run.json"));
  const Call missing =
      call_program(moved / "bin" / "talus", installed.work(), {"run", "scenes/nowhere.json"});
  CHECK(missing.code == 5);
  const Call plugins = call_program(moved / "bin" / "talus", installed.work(), {"plugins"});
  CHECK_THAT(plugins.out,
             Contains((moved / "lib/talus/plugins/liboverlap_area.so").string()) && !Contains("refused"));
}
