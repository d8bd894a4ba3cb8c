#include "files/input_error.hpp"
#include "geometry/gmsh.hpp"
#include "geometry/polygon.hpp"
#include "output/scratch.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <string>
#include <vector>

using namespace talus;

namespace {

const std::string format_2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string format_4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";

/// A unit square of two triangles, one of them clockwise, with a node that nothing uses and two named sides.
const std::string square_2 = format_2 + R"($PhysicalNames
3
1 7 "left"
1 3 "down below"
2 9 "rock"
$EndPhysicalNames
$Nodes
5
10 0 0 0
20 1 0 0
99 7 7 7
30 1 1 0
40 0 1 0
$EndNodes
$Elements
5
1 15 2 0 1 10
2 1 2 3 1 10 20
3 1 2 7 4 10 40
4 2 2 9 1 10 20 30
5 2 2 9 1 10 40 30
$EndElements
)";

/// The same in MSH 4.1, with a section that is of no interest.
const std::string square_4 = format_4 + R"($PhysicalNames
3
1 7 "left"
1 3 "down below"
2 9 "rock"
$EndPhysicalNames
$Entities
1 2 1 0
1 0 0 0 0
1 0 0 0 1 0 0 1 3 2 1 -2
4 0 0 0 0 1 0 1 -7 0
1 0 0 0 1 1 0 1 9 2 1 4
$EndEntities
$Nodes
2 5 10 99
0 1 0 1
10
0 0 0
2 1 0 4
20
99
30
40
1 0 0
7 7 7
1 1 0
0 1 0
$EndNodes
$Periodic
nobody reads this
$EndPeriodic
$Elements
4 5 1 5
0 1 15 1
1 10
1 1 1 1
2 10 20
1 4 1 1
3 10 40
2 1 2 2
4 10 20 30
5 10 40 30
$EndElements
)";

std::string nodes_2(const std::vector<Vec2>& nodes) {
  std::string text = fmt::format("$Nodes\n{}\n", nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    text += fmt::format("{} {} {} 0\n", i + 1, nodes[i].x, nodes[i].y);
  }
  return text + "$EndNodes\n";
}

/// Lines of elements without their numbers.
std::string elements_2(const std::vector<std::string>& elements) {
  std::string text = fmt::format("$Elements\n{}\n", elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i) text += fmt::format("{} {}\n", i + 1, elements[i]);
  return text + "$EndElements\n";
}

/// A square of 3 × 3 cells without the one in the middle.
std::string frame() {
  std::vector<Vec2> nodes;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) nodes.push_back({1.0 * i, 1.0 * j});
  }
  std::vector<std::string> elements{"1 2 1 1 6 7", "1 2 2 1 6 10"};
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      if (i == 1 && j == 1) continue;
      const int a = 1 + i + 4 * j;
      elements.push_back(fmt::format("2 2 5 1 {} {} {}", a, a + 1, a + 5));
      elements.push_back(fmt::format("2 2 5 1 {} {} {}", a, a + 5, a + 4));
    }
  }
  return format_2 + nodes_2(nodes) + elements_2(elements);
}

double area_of(const GmshMesh& mesh, const std::vector<std::uint32_t>& nodes) {
  Ring ring;
  for (const std::uint32_t node : nodes) ring.push_back(mesh.nodes[node]);
  return ring_moments(ring, {0, 0}).area;
}

std::string refusal(const std::string& text, const std::string& group = "") {
  try {
    read_gmsh_text(text, "a.msh", group);
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was refused";
}

/// The text with the first `old` replaced.
std::string with(std::string text, const std::string& old, const std::string& changed) {
  const std::size_t at = text.find(old);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old.size(), changed);
}

using Names = std::vector<std::string>;
using Numbers = std::vector<std::uint32_t>;

}  // namespace

TEST_CASE("a square of two triangles reads the same from MSH 2.2 and 4.1", "[geometry][gmsh]") {
  for (const std::string& text : {square_2, square_4, with(square_2, "2.2 0 8\n", "2.2 0 8\r\n")}) {
    const GmshMesh mesh = read_gmsh_text(text, "a.msh");
    REQUIRE(mesh.nodes.size() == 4);  // the one without a triangle is gone
    CHECK(mesh.nodes[2].x == 1);
    CHECK(mesh.nodes[3].x == 0);
    REQUIRE(mesh.triangles.size() == 2);
    CHECK(mesh.triangles[0] == std::array<std::uint32_t, 3>{0, 1, 2});
    CHECK(mesh.triangles[1] == std::array<std::uint32_t, 3>{0, 2, 3});  // turned counter-clockwise
    REQUIRE(mesh.loops.size() == 1);
    CHECK(mesh.loops[0].nodes == Numbers{0, 1, 2, 3});
    CHECK(mesh.loops[0].surfaces == Names{"down below", "", "", "left"});
  }
}

TEST_CASE("a mesh with a hole has an outer loop and a clockwise one", "[geometry][gmsh]") {
  const GmshMesh mesh = read_gmsh_text(frame(), "a.msh");
  CHECK(mesh.nodes.size() == 16);
  CHECK(mesh.triangles.size() == 16);
  REQUIRE(mesh.loops.size() == 2);
  CHECK(mesh.loops[0].nodes.size() == 12);
  CHECK(area_of(mesh, mesh.loops[0].nodes) == 9);
  CHECK(mesh.loops[1].nodes == Numbers{5, 9, 10, 6});
  CHECK(area_of(mesh, mesh.loops[1].nodes) == -1);
  // Groups without names go by their numbers.
  CHECK(mesh.loops[1].surfaces == Names{"2", "", "", "1"});
  CHECK(mesh.loops[0].surfaces == Names(12, ""));

  // The outer loop comes first even where a node of the hole does.
  const std::string moved = with(with(frame(), "\n6 1 1 0\n", "\n"), "\n1 0 0 0\n", "\n6 1 1 0\n1 0 0 0\n");
  const GmshMesh other = read_gmsh_text(moved, "a.msh");
  REQUIRE(other.loops.size() == 2);
  CHECK(other.loops[0].nodes.size() == 12);
  CHECK(other.loops[1].nodes[0] == 0);
}

TEST_CASE("a physical group picks its triangles", "[geometry][gmsh]") {
  const std::vector<Vec2> nodes{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {5, 0}, {6, 0}, {6, 1}};
  // The first triangle is in two groups and so written twice.
  const std::string text =
      format_2 + "$PhysicalNames\n2\n2 1 \"here\"\n2 2 \"there\"\n$EndPhysicalNames\n" + nodes_2(nodes) +
      elements_2({"2 2 1 1 1 2 3", "2 2 3 1 1 2 3", "2 2 1 1 1 3 4", "2 2 2 2 5 6 7", "1 2 8 9 6 7"});
  CHECK(read_gmsh_text(text, "a.msh", "here").triangles.size() == 2);
  CHECK(read_gmsh_text(text, "a.msh", "3").triangles.size() == 1);
  const GmshMesh there = read_gmsh_text(text, "a.msh", "there");
  REQUIRE(there.nodes.size() == 3);
  CHECK(there.nodes[0].x == 5);
  CHECK(there.loops[0].surfaces == Names{"", "8", ""});
  CHECK(refusal(text, "elsewhere") ==
        "a.msh: no triangle is in the physical group \"elsewhere\"; there are: 3, here, there");
  CHECK_THAT(refusal(text), Catch::Contains("a.msh: the mesh has 2 parts that do not touch (nodes 1 and 5"));
  CHECK(read_gmsh_text(square_4, "a.msh", "rock").triangles.size() == 2);
}

TEST_CASE("a mesh file is read from disk and named in its refusal", "[geometry][gmsh]") {
  const Scratch scratch;
  CHECK(read_gmsh(scratch.write("square.msh", square_2)).triangles.size() == 2);
  const std::string file = scratch.write("empty.msh", "");
  CHECK_THROWS_WITH(read_gmsh(file), Catch::Contains("empty.msh:0: there is no section $MeshFormat"));
  CHECK_THROWS_AS(read_gmsh(scratch / "none.msh"), std::system_error);
}

TEST_CASE("a file that is no text mesh of a known version is refused by file and line", "[geometry][gmsh]") {
  CHECK_THAT(refusal("{\"talus\": 1}"),
             Catch::StartsWith("a.msh:1: '{\"talus\": 1}' stands where a section"));
  CHECK_THAT(refusal("$Nodes\n0\n$EndNodes\n"),
             Catch::StartsWith("a.msh:1: there is no section $MeshFormat"));
  CHECK_THAT(refusal(with(square_2, "2.2 0 8", "4 0 8")),
             Catch::StartsWith("a.msh:2: the format is MSH '4', wanted 2.2 or 4.1"));
  CHECK_THAT(refusal(with(square_2, "2.2 0 8", "2.2 1 8")), Catch::StartsWith("a.msh:2: the mesh is binary"));
  CHECK_THAT(refusal(format_2), Catch::StartsWith("a.msh: there are no triangles"));
  CHECK_THAT(refusal(std::string("\x01\xff\xfe\n", 4)), Catch::Contains("something that is no text stands"));
  std::string long_word = "a";
  for (int i = 0; i < 26; ++i) long_word += "é";
  CHECK_THAT(refusal(long_word + "\n"), Catch::Contains("'" + long_word.substr(0, 39) + "' stands"));
}

TEST_CASE("a broken mesh file is refused by file and line", "[geometry][gmsh]") {
  const auto check = [](const std::string& text, const std::string& words) {
    CHECK_THAT(refusal(text), Catch::Contains(words));
  };
  check(with(square_2, "20 1 0 0", "20 1 x 0"), "a.msh:13: 'x' stands where a coordinate should");
  check(with(square_2, "20 1 0 0", "20 1 nan 0"), "a.msh:13: a coordinate is not finite");
  check(with(square_2, "20 1 0 0", "20 1"), "a.msh:13: the line ends where a coordinate should follow");
  check(with(square_2, "20 1 0 0", "10 1 0 0"), "a.msh:13: node 10 is there twice");
  check(with(square_2, "20 1 0 0", "-2 1 0 0"), "a.msh:13: '-2' stands where the number of a node should");
  check(with(square_2, "9 1 10 20 30", "9 1 10 20 31"), "a.msh:23: there is no node 31");
  check(with(square_2, "3 1 10 20", "3 1 10 21"), "a.msh:21: there is no node 21");
  check(with(square_2, "9 1 10 20 30", "9 1 10 20"),
        "a.msh:23: the line ends where the number of a node should");
  check(with(square_2, "4 2 2 9", "4 2 99999999999 9"), "a.msh:23: the line ends where a tag of an element");
  check(with(square_2, "$EndElements", "$EndMesh"), "a.msh:25: '$EndMesh' stands where $EndElements should");
  check(with(square_2, "\"rock\"", "rock"),
        "a.msh:8: the name of a physical group should stand in double quotes");
  check(with(square_2, "\"rock\"", "\"\xc3\""), "a.msh:8: the name of a physical group holds characters");
  check(with(square_2, "1 3 \"down", "1 7 \"down"),
        "a.msh:7: the physical group 7 of dimension 1 is named twice");
  check(square_2 + "$Comments\nend", "a.msh:27: the section '$Comments' is not closed");
  check(with(square_4, "1 0 0 0 1 0 0 1 3 2 1 -2", "1 0 0 0 1 0 0 5 3"),
        "a.msh:13: the line ends where the number");
  check(with(square_4, "4 0 0 0 0 1 0", "1 0 0 0 0 1 0"),
        "a.msh:14: the entity 1 of dimension 1 is there twice");
  check(with(square_4, "1 -7", "1 -9223372036854775808"), "a.msh:14: a physical group has no such number");
}

TEST_CASE("what a mesh file claims to hold is not believed", "[geometry][gmsh]") {
  const std::string many = "18446744073709551615";
  CHECK_THAT(refusal(with(square_2, "$Nodes\n5", "$Nodes\n" + many)),
             Catch::Contains("a.msh:17: the section ends where a node should follow"));
  CHECK_THAT(refusal(with(square_2, "$Elements\n5", "$Elements\n" + many)),
             Catch::Contains("a.msh:25: the section ends where an element should follow"));
  CHECK_THAT(refusal(with(square_2, "$Elements\n5", "$Elements\n4")),
             Catch::Contains("a.msh:24: '5 2 2 9 1 10 40 30' stands where $EndElements should"));
  CHECK_THAT(refusal(with(square_4, "2 1 0 4\n20", "2 1 0 " + many + "\n20")),
             Catch::Contains("a.msh:31: the section ends where the number of a node should follow"));
  CHECK_THAT(refusal(with(square_4, "4 5 1 5", many + " 5 1 5")),
             Catch::Contains("the section ends where a block of elements should follow"));
  CHECK_THAT(refusal(with(square_4, "1 2 1 0", "1 2 1 " + many)),
             Catch::Contains("a.msh:16: the section ends where an entity should follow"));
  CHECK_THAT(refusal(with(square_2, "$Nodes\n5", "$Nodes\n" + many + "0")),
             Catch::Contains("a.msh:11: '184467440737095516150' stands where the number of nodes should"));
}

TEST_CASE("cut off anywhere, a mesh file is refused", "[geometry][gmsh]") {
  for (const std::string& text : {square_2, square_4}) {
    const std::size_t last = text.size() - 2;  // without the last line break it is whole
    for (std::size_t length = 0; length <= last; ++length) {
      const std::string words = refusal(text.substr(0, length));
      CHECK(words.starts_with("a.msh:"));
    }
    CHECK(refusal(text) == "nothing was refused");
  }
}

TEST_CASE("elements that are no triangles of three nodes are refused in words", "[geometry][gmsh]") {
  CHECK_THAT(
      refusal(with(square_2, "4 2 2 9 1 10 20 30", "4 9 2 9 1 10 20 30 1 2 3")),
      Catch::StartsWith("a.msh:23: found an element of type 9 (6-node triangle), wanted 3-node triangles") &&
          Catch::Contains("order 1"));
  CHECK_THAT(refusal(with(square_4, "2 1 2 2", "2 1 3 2")), Catch::Contains("type 3 (4-node quadrangle)"));
}

TEST_CASE("a mesh that is no single part of the plane is refused in words", "[geometry][gmsh]") {
  const auto check = [](const std::vector<Vec2>& nodes, const std::vector<std::string>& elements,
                        const std::string& words) {
    CHECK_THAT(refusal(format_2 + nodes_2(nodes) + elements_2(elements)), Catch::Contains(words));
  };
  const std::vector<Vec2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0.4}};
  check(square, {"2 0 1 2 3", "2 0 1 3 4", "2 0 1 3 5"},
        "a.msh:16: more than two triangles meet at the edge from node 1 to node 3");
  check(square, {"2 0 1 2 3", "2 0 1 2 4"},
        "a.msh:15: two triangles overlap at the edge from node 1 to node 2");
  check(square, {"2 0 1 2 2"}, "a.msh:14: a triangle has a corner twice");
  check({{0, 0}, {1, 1}, {2, 2}}, {"2 0 1 2 3"}, "a triangle has no area");
  check({{0, 0}, {1, 0}, {0, 1}, {0, 0}, {-1, -1}, {0, -1}}, {"2 0 1 2 3", "2 0 4 5 6"},
        "a.msh:9: nodes 1 and 4 are at the same place");
  check({{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}}, {"2 0 1 2 3", "2 0 1 4 5"},
        "a.msh:6: the boundary comes to node 1 twice");
  check(square, {"2 0 1 2 3", "2 0 1 3 4", "1 1 7 1 2", "1 1 8 2 1"},
        "a.msh:17: a side is in the physical groups \"7\" and \"8\"");
  CHECK_THAT(refusal(with(square_2, "30 1 1 0", "30 1 1 0.5")),
             Catch::Contains(
                 "a.msh:15: node 30 is at z = 0.5, node 10 at z = 0: the mesh must lie in the x-y plane"));
  CHECK_THAT(refusal(with(with(square_2, "20 1 0 0", "20 1e308 0 0"), "10 0 0 0", "10 -1e308 0 0")),
             Catch::Contains("too large for the computer's numbers"));
}
