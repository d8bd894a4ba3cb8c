#include "files/whole_file.hpp"
#include "limited.hpp"
#include "output/scratch.hpp"

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <functional>

using namespace talus;
using Catch::Matchers::Contains;

namespace {

/// Enough for any of these mistakes to be told, too little for what the scenes ask for.
constexpr Limits modest{0, 2000, 30};

std::string with(const std::string& old_text, const std::string& new_text) {
  std::string scene = small_scene();
  return scene.replace(scene.find(old_text), old_text.size(), new_text);
}

std::string blocks(const std::string& how,
                   const char* domain = "[[0, 10], [1000, 10], [1000, 1010], [0, 1010]]") {
  return with("\"bodies\": [",
              fmt::format(R"("blocks": [{{"name": "g", "domain": {}, "material": "rock", {}}}], "bodies": [)",
                          domain, how));
}

std::string times(int count, const std::function<std::string(int)>& part) {
  std::string all;
  for (int i = 0; i < count; ++i) all += part(i) + ", ";
  return all;
}

std::string repeated(const char* part, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += part;
  return all;
}

struct Hostile {
  const char* name;
  std::function<std::string()> scene;
  const char* said;
};

const Hostile hostile_scenes[] = {
    {"a thousand million cells", [] { return blocks(R"("voronoi": {"count": 1e9})"); }, "about 1e+09 blocks"},
    {"bricks of a nanometre on a kilometre",
     [] { return blocks(R"("bricks": {"width": 1e-9, "height": 1e-9})"); }, "are the spacings in metres?"},
    {"joints without a distance", [] { return blocks(R"("joint_sets": [{"dip": 3, "spacing": 1e-300}])"); },
     "are the spacings in metres?"},
    {"joints a hand apart on a kilometre",
     [] { return blocks(R"("joint_sets": [{"dip": 90, "spacing": 50}, {"dip": -20, "spacing": 0.1}])"); },
     "/blocks/0/joint_sets/1/spacing: 0.1 would make about 1.28e+04 joints of one set"},
    {"cells in a sliver",
     [] { return blocks(R"("voronoi": {"count": 100})", "[[0, 10], [1000, 1010], [1000, 1010.00001]]"); },
     "too little to find points within"},
    {"100,000 brackets", [] { return std::string(100'000, '['); }, "nested too deep"},
    {"100,000 objects", [] { return repeated("{\"a\":", 100'000); }, "nested too deep"},
    {"a number beyond doubles", [] { return with("0.2}", "1e400}"); }, "1e400 is out of range"},
    {"a number that is none", [] { return with("0.2}", "NaN}"); }, "'NaN' is no JSON value"},
    {"a text for a number", [] { return with("0.2}", "\"NaN\"}"); }, "\"NaN\" is not allowed here"},
    {"a row each 1e-300 s", [] { return with("\"history\": 0.01, \"frames\": 0.1", "\"history\": 1e-300"); },
     "/output/history: "},
    {"a name of 20 MB",
     [] { return with("\"name\": \"block\"", "\"name\": \"" + std::string(20'000'000, 'n') + '"'); },
     "is no name: expected text of up to 200 bytes"},
    {"100,000 times the same key",
     [] { return with("\"title\"", repeated("\"title\": 1, ", 100'000) + "\"title\""); },
     "the rest is not read"},
    {"100,000 unknown keys",
     [] {
       return with("\"title\"",
                   times(100'000, [](int i) { return fmt::format("\"t{}\": 1", i); }) + "\"title\"");
     },
     "more mistakes"},
    {"a million monitors that are none",
     [] { return with("\"monitors\": [", "\"monitors\": [" + repeated("3, ", 1'000'000)); }, "more mistakes"},
    {"20,000 bodies of an unknown material",
     [] {
       return with("\"bodies\": [", "\"bodies\": [" + times(20'000, [](int i) {
                                      return fmt::format(
                                          "{{\"name\": \"b{0}\", \"material\": \"b{0}\", \"polygon\": "
                                          "[[{1}, 5], [{1}.5, 5], [{1}, 6]]}}",
                                          i, 2 * i);
                                    }));
     },
     "more mistakes"},
    {"coordinates beyond all", [] { return with("[[-2, -1]", "[[1e308, -1]"); }, "out of range"},
    {"a needle of rounding",
     [] {
       return with(
           "\"bodies\": [",
           "\"bodies\": [{\"name\": \"needle\", \"material\": \"rock\", \"polygon\": [[9.964599609375, 190], "
           "[3, 202], [2, 200], [1.9999999999745341, 200]]},");
     },
     "body 'needle': it cannot be cut into convex pieces"},
    {"a plugin that is a device", [] { return with("\"title\"", "\"plugins\": [\"/dev/zero\"], \"title\""); },
     "--allow-plugins"},
    {"bytes that are no text", [] { return repeated("\xff\xfe", 1000); }, "1:1"},
    {"nothing", [] { return std::string(); }, "the file ends"},
};

}  // namespace

TEST_CASE("Scenes that ask for everything end in words, in modest memory and time",
          "[faults][slow_sanitised]") {
  const Scratch scratch;
  for (const Hostile& hostile : hostile_scenes) {
    CAPTURE(hostile.name);
    scratch.write("scene.json", hostile.scene());
    const Call call = call_within(modest, scratch.folder(), {"run", "scene.json", "--out", "out", "--quiet"});
    CHECK((call.code == 2 || call.code == 3));
    CHECK_THAT(call.err.substr(0, 3000) +
                   call.err.substr(call.err.size() - std::min<std::size_t>(call.err.size(), 3000)),
               Contains(hostile.said));
    CHECK(call.err.size() < 1'000'000);
    CHECK_FALSE(std::filesystem::exists(scratch / "out"));
  }
}

TEST_CASE("Steps that nobody can wait for are refused", "[faults]") {
  const Scratch scratch;
  scratch.write("scene.json", small_scene());
  for (const char* change : {"/time/dt=1e-300", "/time/end=1e300"}) {
    CAPTURE(change);
    const Call call = call_within(
        modest, scratch.folder(),
        {"run", "scene.json", "--out", "out", "--overwrite", "--set", change, "--set", "/output={}"});
    CHECK(call.code == 2);
    CHECK_THAT(call.err, Contains("more than any run can do"));
  }
}

TEST_CASE("a settle stage without end is refused before results of an earlier run are touched", "[faults]") {
  const Scratch scratch;
  scratch.write("scene.json", small_scene());
  REQUIRE(call_talus(scratch.folder(), {"run", "scene.json", "--out", "out"}).code == 0);
  const std::string before = read_whole_file(scratch / "out/run.json");
  const Call call = call_talus(scratch.folder(), {"run", "scene.json", "--out", "out", "--overwrite", "--set",
                                                  R"(/settle={"duration": 1e300, "damping": 1})"});
  CHECK(call.code == 2);
  CHECK_THAT(call.err, Contains("to the end of /settle") && Contains("more than any run can do"));
  CHECK(read_whole_file(scratch / "out/run.json") == before);
}

TEST_CASE("A run that nobody would wait for runs until it is stopped", "[faults]") {
  const Scratch scratch;
  scratch.write("scene.json", with("0.2}", "1e12}"));
  const Call call = call_within(
      modest, scratch.folder(),
      {"run", "scene.json", "--out", "out", "--quiet", "--wall-time", "0.2", "--set", "/output={}"});
  CHECK(call.code == 130);
}
