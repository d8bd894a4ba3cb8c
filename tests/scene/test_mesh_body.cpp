#include "geometry/outlines.hpp"
#include "output/scratch.hpp"
#include "scene/sample.hpp"

#include <nlohmann/json.hpp>

#include <catch2/catch.hpp>

using namespace talus;
using nlohmann::json;

namespace {

/// A square ring of eight triangles from (1, 1) to (4, 4) around a hole from (2, 2) to (3, 3), in group
/// "ring"; its lower side is "base", two sides of the hole are "tunnel".
std::string ring_mesh(const std::string& tunnel = "tunnel", const std::string& corner = "1 1 0") {
  return R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
1 1 "base"
1 2 ")" + tunnel +
         R"("
2 3 "ring"
$EndPhysicalNames
$Nodes
8
1 )" + corner +
         R"(
2 4 1 0
3 4 4 0
4 1 4 0
5 2 2 0
6 3 2 0
7 3 3 0
8 2 3 0
$EndNodes
$Elements
11
1 1 2 1 1 1 2
2 1 2 2 2 5 6
3 1 2 2 2 6 7
4 2 2 3 3 1 2 6
5 2 2 3 3 1 6 5
6 2 2 3 3 2 3 7
7 2 2 3 3 2 7 6
8 2 2 3 3 3 4 8
9 2 2 3 3 3 8 7
10 2 2 3 3 4 1 5
11 2 2 3 3 4 5 8
$EndElements
)";
}

const std::string polygon = "\"polygon\": [[1, 1], [2, 1], [2, 2], [1, 2]]";

std::string block_of(const std::string& shape) {
  return sample::good_but(polygon, shape);
}

Scene read(const Scratch& scratch, const std::string& text) {
  static Registry registry = sample::registry();
  return read_scene_text(text, (scratch / "scene.json").string(), registry);
}

std::vector<Mistake> mistakes(const Scratch& scratch, const std::string& text) {
  try {
    read(scratch, text);
  } catch (const SceneError& error) {
    return error.mistakes;
  }
  return {};
}

}  // namespace

TEST_CASE("a body takes its shape, its surfaces and its triangles from a mesh", "[scene]") {
  const Scratch scratch;
  scratch.write("ring.msh", ring_mesh());
  const Scene scene = read(scratch, block_of("\"mesh\": \"ring.msh\""));
  const SceneBody& body = scene.bodies[1];
  CHECK(body.mesh.nodes.size() == 8);
  CHECK(body.mesh.corners.size() == 8);
  REQUIRE(body.outer.vertices.size() == 4);
  REQUIRE(body.holes.size() == 1);
  REQUIRE(body.holes[0].vertices.size() == 4);
  CHECK(signed_area(body.outer.vertices) == 9);
  CHECK(signed_area(body.holes[0].vertices) == -1);
  std::size_t tunnel = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 a = body.outer.vertices[i], b = body.outer.vertices[(i + 1) % 4];
    const bool is_base = a.y == 1 && b.y == 1;
    CHECK(scene.surfaces[body.outer.surface_class[i]].surface == (is_base ? "base" : ""));
    tunnel += scene.surfaces[body.holes[0].surface_class[i]].surface == "tunnel" ? 1 : 0;
  }
  CHECK(tunnel == 2);
  CHECK(body.cover.component != nullptr);
}

TEST_CASE("surfaces of a mesh carry loads, and points lie in it", "[scene]") {
  const Scratch scratch;
  scratch.write("ring.msh", ring_mesh());
  std::string text = block_of("\"mesh\": \"ring.msh\"");
  const std::string time = "\"time\":";
  text.replace(text.find(time), time.size(),
               R"("surface_loads": [{"body": "block", "surface": "tunnel", "pressure": 1}], "time":)");
  const Scene scene = read(scratch, text);
  CHECK(scene.surfaces[scene.surface_loads[0].surface_class].surface == "tunnel");
  text.replace(text.find("\"point\": [2, 2]"), 15, "\"point\": [2.5, 2.5]");
  const auto found = mistakes(scratch, text);
  REQUIRE(found.size() == 1);
  CHECK(found[0].pointer == "/loads/0/point");
}

TEST_CASE("a group of a mesh is a body, and the resolved scene finds the file from anywhere", "[scene]") {
  const Scratch scratch;
  scratch.write("ring.msh", ring_mesh());
  const Scene scene = read(scratch, block_of("\"mesh\": \"ring.msh:ring\""));
  CHECK(scene.bodies[1].mesh.corners.size() == 8);
  CHECK(json::parse(scene.resolved)["bodies"][1]["mesh"] == (scratch / "ring.msh").string() + ":ring");
  Registry registry = sample::registry();
  CHECK(read_scene_text(scene.resolved, "/elsewhere/scene.json", registry).resolved == scene.resolved);
}

TEST_CASE("what is wrong with a mesh is told at the pointer with the file", "[scene]") {
  const Scratch scratch;
  const std::string good = scratch.write("ring.msh", ring_mesh()).string();
  const std::string bad = scratch.write("bad.msh", "$MeshFormat\n9 0 8\n$EndMeshFormat\n").string();
  struct Case {
    const char* shape;
    const char* pointer;
    std::string said;
  };
  const std::vector<Case> cases{
      {"\"mesh\": 3", "/bodies/1/mesh", "3 is not allowed here: expected the path of a mesh"},
      {"\"mesh\": \"\"", "/bodies/1/mesh", "no path"},
      {"\"mesh\": \"none.msh\"", "/bodies/1/mesh", "there is no file " + (scratch / "none.msh").string()},
      {"\"mesh\": \".\"", "/bodies/1/mesh", "there is no file "},
      {"\"mesh\": \"bad.msh\"", "/bodies/1/mesh", bad + ":2: "},
      {"\"mesh\": \"ring.msh:rig\"", "/bodies/1/mesh", "\"rig\"; there are: ring"},
      {"\"mesh\": \"ring.msh\", \"surfaces\": {}", "/bodies/1/surfaces", "leaves nothing for \"surfaces\""},
      {"\"mesh\": \"ring.msh\", \"holes\": []", "/bodies/1/holes", "leaves nothing for \"holes\""},
      {"\"mesh\": \"ring.msh\", \"polygon\": []", "/bodies/1/polygon", "leaves nothing for \"polygon\""},
  };
  for (const Case& one : cases) {
    DYNAMIC_SECTION(one.shape) {
      std::string text = block_of(one.shape);
      const std::string load = "\"loads\": [{\"body\": \"block\", \"point\": [2, 2], \"force\": [1, 0]}],";
      text.replace(text.find(load), load.size(), "");
      const auto found = mistakes(scratch, text);
      REQUIRE(found.size() == 1);
      CHECK(found[0].pointer == one.pointer);
      CHECK(found[0].line == 14);
      CHECK_THAT(found[0].message, Catch::Contains(one.said));
    }
  }
}

TEST_CASE("names and coordinates of a mesh are held to what holds for a scene", "[scene]") {
  const Scratch scratch;
  const std::string text = block_of("\"mesh\": \"ring.msh\"");
  const auto said = [&](const std::string& mesh) {
    scratch.write("ring.msh", mesh);
    const auto found = mistakes(scratch, text);
    REQUIRE(found.size() == 1);
    CHECK(found[0].pointer == "/bodies/1/mesh");
    return found[0].message;
  };
  CHECK_THAT(said(ring_mesh("tunnel.1")), Catch::Contains("\"tunnel.1\" is no name"));
  CHECK_THAT(said(ring_mesh("steel")), Catch::Contains("\"steel\" is the name of a material"));
  CHECK_THAT(said(ring_mesh("tunnel", "-2e9 -1e9 0")),
             Catch::Contains("(-2000000000, -1000000000) is out of range"));
}

TEST_CASE("a meshed body that overlaps another is named at its mesh", "[scene]") {
  const Scratch scratch;
  scratch.write("ring.msh", ring_mesh("tunnel", "1 0.5 0"));
  const auto found = mistakes(scratch, block_of("\"mesh\": \"ring.msh\""));
  REQUIRE(found.size() == 1);
  CHECK(found[0].pointer == "/bodies/1/mesh");
  CHECK_THAT(found[0].message, Catch::Contains("\"ramp\" and \"block\" overlap"));
}

TEST_CASE("a body needs a polygon or a mesh", "[scene]") {
  const Scratch scratch;
  std::string text = block_of("\"priority\": 1");
  const auto found = mistakes(scratch, text);
  REQUIRE(found.size() == 1);
  CHECK_THAT(found[0].message, Catch::Contains("required key \"polygon\"") && Catch::Contains("\"mesh\""));
}
