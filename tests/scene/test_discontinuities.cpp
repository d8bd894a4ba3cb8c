#include "scene/bad_scene.hpp"

#include <nlohmann/json.hpp>

#include <catch2/catch.hpp>

using namespace talus;
using nlohmann::json;
using sample::interface_row;
using talus::sample::BadPart;

namespace {

std::string block_with(const std::string& part) {
  return sample::good_but("\"material\": \"rock\"", "\"material\": \"rock\", " + part);
}

/// A single deformable body, with rows of interfaces if there are any.
std::string single(const std::string& part, const std::string& rows = "") {
  std::string text = R"({"talus": 1, "materials": {"rock": {"density": 1}}, "time": {"end": 1},
    "cover": {"model": "rigid"}, "bodies": [{"name": "a", "polygon": [[0, 0], [4, 0], [4, 4], [0, 4]],
    "holes": [[[1, 1], [3, 1], [2, 3]]], "surfaces": {"base": [0], "tunnel": [4, 5], "roof": [6]},
    "material": "rock")" +
                     part + "}]";
  if (!rows.empty()) text += R"(, "contact": {"model": "shear"}, "interfaces": [)" + rows + "]";
  return text + "}";
}

const char* const cut = R"(, "discontinuities": [{"points": [[0, 2], [4, 2]], "surface": "joint"}])";

const BadPart bad_discontinuities[] = {
    {"discontinuities that are no list",
     R"("discontinuities": 1)",
     "/bodies/1/discontinuities",
     "1",
     {"polylines"}},
    {"a discontinuity without points",
     R"("discontinuities": [{"surface": "joint"}])",
     "/bodies/1/discontinuities/0",
     "{\"surface\"",
     {"required key \"points\"", "at least two"}},
    {"a discontinuity of one point",
     R"("discontinuities": [{"points": [[1, 1]]}])",
     "/bodies/1/discontinuities/0/points",
     "[[1, 1]]",
     {"at least two"}},
    {"a point that is none",
     R"("discontinuities": [{"points": [[1, 1], [2]]}])",
     "/bodies/1/discontinuities/0/points/1",
     "[2]",
     {"[x, y]", "[m]"}},
    {"a side without length",
     R"("discontinuities": [{"points": [[1, 1], [2, 2], [2, 2]]}])",
     "/bodies/1/discontinuities/0/points/2",
     "[2, 2]]",
     {"(2, 2) is the point before"}},
    {"a surface that is no text",
     R"("discontinuities": [{"points": [[1, 1], [2, 2]], "surface": 3}])",
     "/bodies/1/discontinuities/0/surface",
     "3",
     {"3 is not allowed here"}},
    {"a surface without a name",
     R"("discontinuities": [{"points": [[1, 1], [2, 2]], "surface": ""}])",
     "/bodies/1/discontinuities/0/surface",
     "\"\"",
     {"is no name"}},
    {"a surface named like a material",
     R"("discontinuities": [{"points": [[1, 1], [2, 2]], "surface": "steel"}])",
     "/bodies/1/discontinuities/0/surface",
     "\"surface\"",
     {"\"steel\" is the name of a material"}},
    {"an unknown key",
     R"("discontinuities": [{"points": [[1, 1], [2, 2]], "surfaces": "a"}])",
     "/bodies/1/discontinuities/0/surfaces",
     "\"surfaces\"",
     {"did you mean \"surface\"", "points, surface"}},
    {"contact with itself that is no truth value",
     R"("self_contact": 1)",
     "/bodies/1/self_contact",
     "1",
     {"true or false"}},
};

}  // namespace

TEST_CASE("every mistake about discontinuities is told with its place and what would be right", "[scene]") {
  for (const BadPart& bad : bad_discontinuities) {
    DYNAMIC_SECTION(bad.requirement) {
      sample::check_alone(bad, block_with(bad.part));
    }
  }
}

TEST_CASE("a fixed body has neither discontinuities nor contact with itself", "[scene]") {
  const auto found = sample::mistakes(sample::good_but(
      "\"fixed\": true",
      R"("fixed": true, "self_contact": true, "discontinuities": [{"points": [[1, 0], [1, 1]]}])"));
  REQUIRE(found.size() == 2);
  CHECK(found[0].pointer == "/bodies/0/self_contact");
  CHECK(found[1].pointer == "/bodies/0/discontinuities");
  CHECK_THAT(found[1].message, Catch::Contains("the body is \"fixed\""));
  // What asks for nothing may be written down.
  CHECK(
      sample::mistakes(sample::good_but("\"fixed\": true", R"("fixed": true, "self_contact": false, "fix": [],
                                                               "drive": {}, "discontinuities": [])"))
          .empty());
}

TEST_CASE("the faces of discontinuities have classes of their own", "[scene]") {
  const Scene scene = sample::read(block_with(R"("discontinuities": [
      {"points": [[0, 0], [2, 2], [3, 2]], "surface": "joint"}, {"points": [[1, 1], [2, 2]]}])"));
  const SceneBody& body = scene.bodies[1];
  REQUIRE(body.discontinuities.size() == 2);
  CHECK(body.discontinuities[0].points.size() == 3);
  CHECK(body.discontinuities[0].points[2].x == 3);
  CHECK(scene.surfaces[body.discontinuities[0].surface_class].surface == "joint");
  CHECK(scene.surfaces[body.discontinuities[0].surface_class].material == "rock");
  CHECK(body.discontinuities[1].surface_class == body.outer.surface_class[0]);
  const json resolved = json::parse(scene.resolved)["bodies"][1];
  CHECK(resolved["discontinuities"][0]["surface"] == "joint");
  CHECK(resolved["self_contact"] == false);
  CHECK(sample::read(scene.resolved).resolved == scene.resolved);
}

TEST_CASE("surfaces of holes are numbered on after those of the polygon, whichever way round", "[scene]") {
  for (const bool turned : {false, true}) {
    std::string text = single("");
    const std::string hole = "[[1, 1], [3, 1], [2, 3]]";
    if (turned) {  // the same sides, so that 4 and 5 are other ones
      text.replace(text.find(hole), hole.size(), "[[1, 1], [2, 3], [3, 1]]");
      text.replace(text.find("[4, 5]"), 6, "[6, 5]");
      text.replace(text.find("\"roof\": [6]"), 11, "\"roof\": [4]");
    }
    const Scene scene = sample::read(text);
    const Loop& loop = scene.bodies[0].holes[0];
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 a = loop.vertices[i], b = loop.vertices[(i + 1) % 3];
      const bool roof = (a.x == 2 && b.x == 1) || (a.x == 1 && b.x == 2);
      CAPTURE(turned, a.x, b.x);
      CHECK(scene.surfaces[loop.surface_class[i]].surface == (roof ? "roof" : "tunnel"));
    }
    CHECK(scene.surfaces[scene.bodies[0].outer.surface_class[0]].surface == "base");
    CHECK(scene.surfaces[scene.bodies[0].outer.surface_class[1]].surface.empty());
  }
}

TEST_CASE("an edge number beyond the last hole is named", "[scene]") {
  std::string text = single("");
  text.replace(text.find("\"roof\": [6]"), 11, "\"roof\": [7]");
  const auto found = sample::mistakes(text);
  REQUIRE(found.size() == 1);
  CHECK_THAT(found[0].message, Catch::Contains("there is no edge 7") && Catch::Contains("from 0 to 6"));
}

TEST_CASE("loads find surfaces of holes and of discontinuities", "[scene]") {
  std::string text = single(cut, interface_row("*", "*", 1));
  text.insert(text.size() - 1, R"(, "surface_loads": [{"body": "a", "surface": "joint", "pressure": 1},
                                   {"body": "a", "surface": "roof", "pressure": 1}])");
  const Scene scene = sample::read(text);
  CHECK(scene.surfaces[scene.surface_loads[0].surface_class].surface == "joint");
  CHECK(scene.surfaces[scene.surface_loads[1].surface_class].surface == "roof");
  text.replace(text.find("\"joint\", \"pressure\""), 7, "\"jont\"");
  const auto found = sample::mistakes(text);
  REQUIRE(found.size() == 1);
  CHECK_THAT(found[0].message,
             Catch::Contains("did you mean \"joint\"") && Catch::Contains("base, joint, roof, tunnel"));
}

TEST_CASE("the faces of a discontinuity meet themselves and the rest of their body", "[scene]") {
  CHECK(sample::mistakes(single("")).empty());
  const auto bare = sample::mistakes(single(cut));
  REQUIRE(bare.size() == 2);
  CHECK_THAT(bare[0].message, Catch::Contains("\"contact\""));
  CHECK_THAT(bare[1].message, Catch::Contains("\"interfaces\""));
  // joint against joint, base, tunnel, roof and the unnamed sides
  CHECK(sample::mistakes(single(cut, interface_row("base", "base", 1))).size() == 5);
  CHECK(sample::mistakes(single(cut, interface_row("joint", "joint", 1))).size() == 4);
  CHECK(sample::mistakes(single(cut, interface_row("joint", "*", 1))).empty());
  CHECK(sample::mistakes(single(cut, interface_row("a/joint", "*", 1))).empty());
  CHECK(sample::read(single(cut, interface_row("joint", "*", 1))).contact.component != nullptr);
}

TEST_CASE("with contact of a body with itself all its surfaces meet", "[scene]") {
  // base, tunnel, roof and the unnamed sides: ten pairs
  CHECK(sample::mistakes(single(R"(, "self_contact": true)", interface_row("base", "base", 1))).size() == 9);
  CHECK(sample::mistakes(single(R"(, "self_contact": true)", interface_row("rock", "*", 1))).empty());
  CHECK(sample::read(single(R"(, "self_contact": true)", interface_row("rock", "*", 1)))
            .bodies[0]
            .self_contact);
  CHECK(sample::mistakes(single(R"(, "self_contact": false)")).empty());
}
