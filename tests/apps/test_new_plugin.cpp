#include "files/whole_file.hpp"
#include "installation.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <algorithm>

using namespace talus;
using Catch::Matchers::Contains;

namespace fs = std::filesystem;

namespace {

/// A project of that kind is written, builds with both compilers, and passes its own tests.
void require_whole(const std::string& kind) {
  const Installation installed;
  const Call written = installed.talus({"new-plugin", kind, "my_first"});
  INFO(written.err);
  REQUIRE(written.code == 0);
  for (const auto& entry : fs::recursive_directory_iterator(installed.work() / "my_first")) {
    INFO(entry.path().string());
    CHECK_THAT(read_whole_file(entry.path()), !Contains("my_component") && !Contains("MyComponent") &&
                                                  !Contains("my_pointer") && !Contains("my_baseline"));
  }
  const Call tested = installed.shell(
      fmt::format("export CMAKE_GENERATOR=Ninja; cmake -S my_first -B gcc && cmake --build gcc && "
                  "ctest --test-dir gcc --output-on-failure"));
  INFO(tested.out << tested.err);
  CHECK(tested.code == 0);
  CHECK_THAT(tested.out, Contains("100% tests passed, 0 tests failed out of 4"));
  const Call reported = installed.shell(
      "talus run my_first/scene.json --plugin-path gcc --set /time/end=0.01 --out ran && "
      "grep -o -e 'talus run [^\"]*--plugin-path [^\"]*gcc' ran/report.html");
  INFO(reported.out << reported.err);
  CHECK(reported.code == 0);  // the command on the page finds the plugin again
  if (!has_compiler("clang++")) {
    WARN("clang++ is not installed: a generated plugin built by it is not tested");
    return;
  }
  const Call other = installed.shell(
      "export CMAKE_GENERATOR=Ninja CXX=clang++ CXXFLAGS='-Wall -Wextra -Wpedantic -Wno-unknown-pragmas "
      "-Werror'; "
      "cmake -S my_first -B clang -DBUILD_TESTING=OFF -DTALUS_SIMD=OFF && cmake --build clang && "
      "talus compare my_first/scene.json --plugin-path clang --vary /time/safety=0.2,0.3 --set "
      "/time/end=0.05");
  INFO(other.out << other.err);
  CHECK(other.code == 0);
}

}  // namespace

TEST_CASE("a generated contact law builds and passes its tests", "[apps][slow]") {
  require_whole("contact");
}

TEST_CASE("a generated material builds and passes its tests", "[apps][slow]") {
  require_whole("material");
}

TEST_CASE("a generated cover builds and passes its tests", "[apps][slow]") {
  require_whole("cover");
}

TEST_CASE("a new plugin has all its files and its name everywhere", "[apps]") {
  const Scratch scratch;
  const Call call = call_talus(scratch.folder(), {"new-plugin", "contact", "soft_law_2"});
  CHECK(call.code == 0);
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(scratch / "soft_law_2"))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  CHECK(names == std::vector<std::string>{"CMakeLists.txt", "README.md", "ci.sh", "scene.json",
                                          "soft_law_2.cpp", "test_soft_law_2.cpp"});
  CHECK_THAT(read_whole_file(scratch / "soft_law_2/soft_law_2.cpp"),
             Contains("class SoftLaw2 final") && Contains("these lines are yours"));
  CHECK((fs::status(scratch / "soft_law_2/ci.sh").permissions() & fs::perms::owner_exec) != fs::perms::none);
  CHECK(call_talus(scratch.folder(), {"new-plugin", "cover", "b", "--out", "deep/er"}).code == 0);
  CHECK(fs::exists(scratch / "deep/er/b.cpp"));
}

TEST_CASE("a new plugin goes to a folder that is written with a slash at its end", "[apps]") {
  const Scratch scratch;
  for (const char* out : {"mine/", "./other/."}) {
    const Call call = call_talus(scratch.folder(), {"new-plugin", "material", "mine", "--out", out});
    INFO(call.err);
    CHECK(call.code == 0);
    CHECK(fs::exists(scratch / out / "mine.cpp"));
  }
}

TEST_CASE("a new plugin is refused in words, and nothing is written", "[apps]") {
  const Scratch scratch;
  const auto refused = [&](const std::vector<std::string>& words) {
    std::vector<std::string> all{"new-plugin"};
    all.insert(all.end(), words.begin(), words.end());
    const Call call = call_talus(scratch.folder(), all);
    CHECK(call.code == 2);
    CHECK(call.out.empty());
    return call.err;
  };
  CHECK_THAT(refused({}), Contains("KIND is missing"));
  CHECK_THAT(refused({"contact"}), Contains("NAME is missing"));
  CHECK_THAT(refused({"contakt", "a"}), Contains("'contakt'") && Contains("did you mean 'contact'?"));
  for (const char* name : {"", "Soft", "9law", "so-ft", "a/b", "..", "a__b", "a_", "_a", "ä"}) {
    CHECK_THAT(refused({"contact", name}),
               Contains(fmt::format("NAME '{}'", name)) && Contains("wanted small letters"));
  }
  CHECK_THAT(refused({"contact", std::string(41, 'a')}), Contains("41 characters") && Contains("at most 40"));
  CHECK_THAT(refused({"material", "test"}), Contains("take another"));
  CHECK_THAT(refused({"contact", "overlap_area"}),
             Contains("liboverlap_area.so") && Contains("take another"));
  CHECK_THAT(refused({"contact", "block"}), Contains("libblock.so"));
  CHECK_THAT(refused({"contact", "a", "b"}), Contains("one KIND and one NAME only"));
  fs::create_directory(scratch / "there");
  CHECK_THAT(refused({"contact", "there"}), Contains("exists: nothing was written") && Contains("--out"));
  CHECK(fs::is_empty(scratch / "there"));
  fs::create_symlink("nowhere", scratch / "leads.txt");
  CHECK_THAT(refused({"contact", "led", "--out", "leads.txt"}), Contains("exists: nothing was written"));
  fs::create_directory(scratch / "mine.unfinished");
  scratch.write("mine.unfinished/notes.txt", "mine");
  CHECK_THAT(refused({"contact", "mine"}), Contains("mine.unfinished' is in the way"));
  CHECK(fs::exists(scratch / "mine.unfinished/notes.txt"));
  for (const auto& entry : fs::directory_iterator(scratch.folder())) {
    INFO(entry.path().string());
    CHECK((entry.path().stem() == "mine" || entry.path().filename() == "there" ||
           entry.path().extension() == ".txt"));
  }
}

TEST_CASE("a new plugin that cannot be written whole leaves nothing behind", "[apps]") {
  const Scratch scratch;
  // No file may be longer than some of a plugin's are.
  const Call call = call_program(
      "/bin/sh", scratch.folder(),
      {"-c", "ulimit -f 1; trap '' XFSZ; exec \"$0\" new-plugin contact mine --out new/folders/mine",
       TALUS_PROGRAM});
  INFO(call.out << call.err);
  CHECK(call.code != 0);
  CHECK_THAT(call.err, Contains("mine.unfinished"));
  CHECK_FALSE(fs::exists(scratch / "new"));
}
