#include "model/model.hpp"
#include "output/scratch.hpp"
#include "scene/read.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace talus;
using Catch::Contains;

namespace {

/// Two bodies too sharp to be cut, one that is sound, and bricks of one element each that should meet
/// themselves.
const std::string refused = R"({
  "talus": 1,
  "materials": {"rock": {"density": 2300}},
  "cover": {"model": "rigid"},
  "contact": {"model": "frictionless"},
  "interfaces": [{"between": ["*", "*"], "normal_stiffness": 1e9, "normal_damping": 0}],
  "blocks": [
    {"name": "wall", "domain": [[0, 0], [2, 0], [2, 1], [0, 1]], "material": "rock",
     "self_contact": true, "bricks": {"width": 1, "height": 1}}
  ],
  "bodies": [
    {"name": "needle", "material": "rock",
     "polygon": [[9.964599609375, 190], [3, 202], [2, 200], [1.9999999999745341, 200]]},
    {"name": "sound", "material": "rock", "polygon": [[0, 5], [1, 5], [1, 6]]},
    {"name": "splinter", "material": "rock",
     "polygon": [[29.964599609375, 190], [23, 202], [22, 200], [21.9999999999745341, 200]]}
  ],
  "time": {"end": 1}
})";

std::vector<Mistake> mistakes_of(const Scene& scene) {
  try {
    build_model(scene);
  } catch (const SceneError& problem) {
    return problem.mistakes;
  }
  return {};
}

}  // namespace

TEST_CASE("Bodies refused when they are built are named with their places, all at once", "[scene]") {
  const Scratch scratch;
  const std::filesystem::path file = scratch.write("refused.json", refused);
  const std::vector<Mistake> found = mistakes_of(read_scene(file, shipped_registry()));
  REQUIRE(found.size() == 4);
  struct Expected {
    const char* pointer;
    std::size_t line, column;
    const char* words;
  };
  const Expected expected[] = {{"/blocks/0", 8, 5, "self_contact"},
                               {"/blocks/0", 8, 5, "self_contact"},
                               {"/bodies/0", 12, 5, "body 'needle': it cannot be cut into convex pieces"},
                               {"/bodies/2", 15, 5, "body 'splinter': it cannot be cut"}};
  for (std::size_t i = 0; i < 4; ++i) {
    CAPTURE(i);
    CHECK(found[i].file == file.string());
    CHECK(found[i].pointer == expected[i].pointer);
    CHECK(found[i].line == expected[i].line);
    CHECK(found[i].column == expected[i].column);
    CHECK_THAT(found[i].message, Contains(expected[i].words));
  }
  CHECK(found[0].message != found[1].message);
}

TEST_CASE("A refused body that an override wrote is placed there", "[scene]") {
  const Scratch scratch;
  const std::filesystem::path file = scratch.write("refused.json", refused);
  ReadOptions options;
  options.overrides = {{"/bodies/2/polygon", "[[0, 7], [1, 7], [1, 8]]"},
                       {"/blocks/0/self_contact", "false"}};
  const std::vector<Mistake> sound_again = mistakes_of(read_scene(file, shipped_registry(), options));
  REQUIRE(sound_again.size() == 1);
  CHECK(sound_again[0].pointer == "/bodies/0");
  options.overrides = {{"/bodies", R"([{"name": "only", "material": "rock", "self_contact": true,
                                        "polygon": [[0, 7], [1, 7], [1, 8]]}])"},
                       {"/blocks/0/self_contact", "false"}};
  const std::vector<Mistake> written = mistakes_of(read_scene(file, shipped_registry(), options));
  REQUIRE(written.size() == 1);
  CHECK(written[0].line == 0);
  CHECK_THAT(written[0].file, Contains("--set /bodies="));
  CHECK_THAT(written[0].message, Contains("body 'only' has \"self_contact\""));
}

TEST_CASE("A scene that came from no file has its refused bodies named without a line", "[scene]") {
  const std::vector<Mistake> found =
      mistakes_of(read_scene_text(refused, "no_file.json", shipped_registry()));
  REQUIRE(found.size() == 4);
  CHECK(found[0].line == 0);
  CHECK_THAT(found[0].text(), Contains("no_file.json: /bodies/0: body 'needle'"));
}
