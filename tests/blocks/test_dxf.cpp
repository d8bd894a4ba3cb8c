#include "blocks/dxf.hpp"

#include "blocks/generator.hpp"
#include "files/input_error.hpp"
#include "output/scratch.hpp"
#include "scene/sample.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <set>

using namespace talus;
using Catch::Matchers::Contains;

namespace {

std::string drawing(const std::string& entities) {
  return "  0\nSECTION\n  2\nHEADER\n  9\n$ACADVER\n  1\nAC1015\n  0\nENDSEC\n  0\nSECTION\n  2\nENTITIES\n" +
         entities + "  0\nENDSEC\n  0\nEOF\n";
}

const std::string line = "  0\nLINE\n  8\nfault\n 10\n0.0\n 20\n0.5\n 11\n1.0\n 21\n0.5\n";
const std::string light =
    "  0\nLWPOLYLINE\n  8\n0\n 90\n3\n 70\n1\n 10\n0.1\n 20\n0.1\n 10\n0.3\n 20\n0.1\n 10\n0.2\n 20\n0.3\n";
const std::string old_polyline =
    "  0\nPOLYLINE\n  8\ncross\n 66\n1\n 70\n0\n  0\nVERTEX\n  8\ncross\n 10\n0.5\n 20\n0.5\n"
    "  0\nVERTEX\n  8\ncross\n 10\n0.6\n 20\n0.8\n  0\nVERTEX\n  8\ncross\n 10\n0.5\n 20\n1\n  0\nSEQEND\n  "
    "8\n0\n";

std::string refusal(const std::string& text) {
  try {
    read_dxf_text(text, "d.dxf");
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

Scene read_in(const Scratch& scratch, const std::string& text) {
  static Registry registry = sample::registry();
  return read_scene_text(text, (scratch / "scene.json").string(), registry);
}

}  // namespace

TEST_CASE("what CAD does not show is passed over, and lines of hidden layers are told", "[blocks]") {
  std::string hidden = line;
  hidden.insert(hidden.find(" 10\n"), " 60\n1\n");
  const DxfDrawing read = read_dxf_text(drawing(hidden + line), "d.dxf");
  CHECK(read.lines.size() == 1);
  CHECK(read.passed_over.at("LINE invisible") == 1);

  const std::string tables =  // CAD does not tell large letters from small ones
      "  0\nSECTION\n  2\nTABLES\n  0\nTABLE\n  2\nLAYER\n 70\n3\n  0\nLAYER\n  5\n1E99\n  2\nFault\n "
      "70\n0\n 62\n-7\n"
      "  0\nLAYER\n  2\ncross\n 70\n1\n 62\n7\n  0\nLAYER\n  2\nshown\n 70\n0\n 62\n7\n  0\nENDTAB\n  "
      "0\nENDSEC\n";
  const std::string all = tables + drawing(line);
  CHECK(read_dxf_text(all, "d.dxf").hidden_layers == std::set<std::string>{"Fault", "cross"});
  const Scratch scratch;
  scratch.write("d.dxf", all);
  const Scene scene = read_in(scratch, generator_scene(R"("dxf": "d.dxf")"));
  CHECK(std::ranges::any_of(scene.warnings, [](const std::string& warning) {
    return warning.find("layer 'Fault' is switched off or frozen") != std::string::npos;
  }));
  CHECK(std::ranges::none_of(scene.warnings, [](const std::string& warning) {
    return warning.find("'cross'") != std::string::npos;
  }));
}

TEST_CASE("lines and polylines of a drawing are read with their layers", "[blocks]") {
  const DxfDrawing read = read_dxf_text(drawing(line + light + old_polyline), "d.dxf");
  REQUIRE(read.lines.size() == 3);
  CHECK(read.lines[0].layer == "fault");
  REQUIRE(read.lines[0].points.size() == 2);
  CHECK(read.lines[0].points[1].x == 1);
  CHECK(read.lines[0].points[1].y == 0.5);
  CHECK(read.lines[1].layer == "0");
  REQUIRE(read.lines[1].points.size() == 4);  // closed
  CHECK(read.lines[1].points[3].x == 0.1);
  CHECK(read.lines[2].layer == "cross");
  REQUIRE(read.lines[2].points.size() == 3);
  CHECK(read.lines[2].points[1].y == 0.8);
  CHECK(read.passed_over.empty());
}

TEST_CASE("line ends of Windows, points twice in a row and other entities do not disturb", "[blocks]") {
  std::string text = drawing("  0\nCIRCLE\n  8\n0\n 10\n1\n 20\n1\n 40\n3\n" + light +
                             "  0\nLINE\n 67\n1\n 10\n0\n 20\n0\n 11\n1\n 21\n1\n");
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, "\r");
  const DxfDrawing read = read_dxf_text(text, "d.dxf");
  REQUIRE(read.lines.size() == 1);
  CHECK(read.passed_over.at("CIRCLE") == 1);
  CHECK(read.passed_over.at("LINE not of the plane") == 1);  // it stands on a sheet
}

TEST_CASE("drawings of other programs are read as they come", "[blocks]") {
  const DxfDrawing commented = read_dxf_text(
      "\xEF\xBB\xBF"
      "999\nmade by hand\n" +
          drawing("999\nnote\n" + line),
      "d.dxf");
  CHECK(commented.lines.size() == 1);
  // A point twice is no line.
  const DxfDrawing point = read_dxf_text(drawing("  0\nLINE\n 10\n1\n 11\n1\n" + line), "d.dxf");
  CHECK(point.lines.size() == 1);
  CHECK(point.passed_over.at("LINE without length") == 1);
  // Of a curve what controls it is not on it.
  const auto vertex = [](const char* x, const char* flags) {
    return fmt::format("  0\nVERTEX\n 10\n{}\n 20\n0\n 70\n{}\n", x, flags);
  };
  const DxfDrawing curve =
      read_dxf_text(drawing("  0\nPOLYLINE\n 70\n4\n" + vertex("0", "8") + vertex("1", "8") +
                            vertex("5", "16") + vertex("7", "16") + "  0\nSEQEND\n"),
                    "d.dxf");
  REQUIRE(curve.lines.size() == 1);
  CHECK(curve.lines[0].points.size() == 2);
  CHECK(curve.lines[0].points[1].x == 1);
  // Older ones have no UTF-8.
  std::string named = line;
  named.replace(named.find("fault"), 5,
                "Kl\xFC"
                "fte");
  CHECK(read_dxf_text(drawing(named), "d.dxf").lines[0].layer ==
        "Kl\xC3\xBC"
        "fte");
}

TEST_CASE("numbers may have a sign, and layers letters that ASCII has not", "[blocks]") {
  std::string text = line;
  text.replace(text.find("1.0"), 3, "+1.0");
  text.replace(text.find("fault"), 5, "Kl\\U+00FCfte \\U+03B1\\U+20AC \\U+D83D \\U+12");
  const DxfDrawing read = read_dxf_text(drawing(text), "d.dxf");
  REQUIRE(read.lines.size() == 1);
  CHECK(read.lines[0].points[1].x == 1);
  CHECK(read.lines[0].layer ==
        "Kl\xC3\xBC"
        "fte \xCE\xB1\xE2\x82\xAC \\U+D83D \\U+12");
}

TEST_CASE("lines in space are taken where they are level, and told where they are not", "[blocks]") {
  const auto in_space = [](const char* flags, const char* z) {
    return fmt::format(
        "  0\nPOLYLINE\n 70\n{}\n  0\nVERTEX\n 10\n0\n 20\n0\n 30\n7\n  0\nVERTEX\n 10\n1\n 20\n0\n "
        "30\n{}\n  0\nSEQEND\n",
        flags, z);
  };
  const DxfDrawing level = read_dxf_text(drawing(in_space("8", "7") + in_space("9", "7")), "d.dxf");
  REQUIRE(level.lines.size() == 2);
  CHECK(level.lines[0].points[1].x == 1);
  CHECK(level.lines[1].points.size() == 3);  // closed
  CHECK(level.passed_over.empty());
  CHECK(level.flattened.empty());
  const DxfDrawing rising = read_dxf_text(
      drawing(in_space("8", "7.5") + in_space("0", "7.5") + "  0\nLINE\n 10\n0\n 30\n1\n 11\n1\n 31\n2\n"),
      "d.dxf");
  CHECK(rising.lines.size() == 2);
  CHECK(rising.passed_over.at("POLYLINE not of the plane") == 1);
  CHECK(rising.flattened.at("POLYLINE") == 1);
  CHECK(rising.flattened.at("LINE") == 1);
  // A mesh is no line, however level.
  CHECK(read_dxf_text(drawing(in_space("16", "7")), "d.dxf").lines.empty());
  const Scratch scratch;
  std::string dipping = line;
  dipping.insert(dipping.find(" 11"), " 30\n3\n");
  scratch.write("joints.dxf", drawing(dipping));
  const Scene scene = read_in(scratch, generator_scene(R"("dxf": "joints.dxf")"));
  REQUIRE(scene.warnings.size() == 1);
  CHECK_THAT(scene.warnings[0], Contains("joints.dxf: 1 of the kind LINE") && Contains("seen from above"));
}

TEST_CASE("what is wrong with a drawing is told with its line", "[blocks]") {
  CHECK_THAT(refusal("hello\n"), Contains("d.dxf:1: 'hello' stands where the code"));
  CHECK_THAT(refusal("  0\nEOF\n"), Contains("d.dxf:2: this is no DXF"));
  CHECK_THAT(refusal(""), Contains("no DXF"));
  CHECK_THAT(refusal("AutoCAD Binary DXF\r\n"), Contains("save it as text"));
  CHECK_THAT(refusal("AC1032\0\n"), Contains("this is a DWG: save it as a DXF"));
  CHECK_THAT(refusal("  0\nSECTION\n  2\nHEADER\n  0\nENDSEC\n  0\nEOF\n"), Contains("no section ENTITIES"));
  CHECK_THAT(refusal("  0\nSECTION\n  2\nENTITIES\n  0\nLINE\n 10\n"), Contains("ends after the code 10"));
  CHECK_THAT(refusal("  0\nSECTION\n  2\nENTITIES\n  0\nLINE\n 10\n1\n"), Contains("ends within"));
  CHECK_THAT(refusal(drawing("  0\nLINE\n 10\nx\n")), Contains("d.dxf:18: 'x' is no number"));
  std::string arc = light;
  arc.insert(arc.find(" 10\n0.3"), " 42\n0.5\n");
  CHECK_THAT(refusal(drawing(arc)), Contains("arc"));
  std::string last = light + " 42\n0.5\n";  // closed, so it leads to the first
  CHECK_THAT(refusal(drawing(last)), Contains("arc"));
  last.replace(last.find(" 70\n1"), 5, " 70\n0");
  CHECK(refusal(drawing(last)) == "");
  for (const char* unseen : {" 67\n1\n", " 60\n1\n"}) {
    std::string hidden = arc;
    hidden.insert(hidden.find(" 90\n"), unseen);
    CHECK(refusal(drawing(hidden)) == "");
  }
  CHECK_THAT(refusal(drawing(light + "230\n-1\n")), Contains("plane of its own"));
  CHECK_THAT(refusal(drawing("  0\nPOLYLINE\n  0\nLINE\n")), Contains("'LINE' stands where VERTEX"));
  for (const char* flags : {"0.5", "1e9", "-70000"}) {
    std::string flagged = old_polyline;
    flagged.replace(flagged.find("70\n0"), 4, std::string("70\n") + flags);
    CHECK_THAT(refusal(drawing(flagged)),
               Contains("d.dxf:22: '" + std::string(flags) + "' stands where flags, a whole number, should"));
  }
  CHECK_THAT(refusal(drawing("  0\nLWPOLYLINE\n 20\n1\n")), Contains("before the first x (code 10)"));
}

TEST_CASE("a drawing cuts a domain, and its layers name surfaces", "[blocks]") {
  const Scratch scratch;
  scratch.write("joints.dxf", drawing(line + light + old_polyline));
  const Scene scene = read_in(scratch, generator_scene(R"("dxf": "joints.dxf")"));
  REQUIRE(scene.bodies.size() ==
          4);  // above the line left and right of the polyline, below it a triangle cut out
  CHECK(area_sum(scene.bodies) == Approx(1).epsilon(1e-12));
  std::set<std::string> names;
  for (const SurfaceClass& surface : scene.surfaces) names.insert(surface.surface);
  CHECK(names == std::set<std::string>{"", "cross", "fault"});
}

TEST_CASE("what a drawing has besides lines raises a warning", "[blocks]") {
  const Scratch scratch;
  scratch.write("joints.dxf", drawing(line + "  0\nTEXT\n  1\nnote\n"));
  const Scene scene = read_in(scratch, generator_scene(R"("dxf": "joints.dxf")"));
  REQUIRE(scene.warnings.size() == 1);
  CHECK_THAT(scene.warnings[0], Contains("joints.dxf: 1 of the kind TEXT passed over"));
}

TEST_CASE("a layer that is called like a material is told with its file", "[blocks]") {
  const Scratch scratch;
  std::string named = line;
  named.replace(named.find("fault"), 5, "rock");
  scratch.write("joints.dxf", drawing(named));
  try {
    read_in(scratch, generator_scene(R"("dxf": "joints.dxf")"));
    FAIL("was read");
  } catch (const SceneError& error) {
    REQUIRE(error.mistakes.size() == 1);
    CHECK(error.mistakes[0].pointer == "/blocks/0/dxf");
    CHECK_THAT(error.mistakes[0].message, Contains("joints.dxf: layer \"rock\" is the name of a material"));
  }
}

TEST_CASE("a drawing that misses the domain raises a warning", "[blocks]") {
  const Scratch scratch;
  std::string far = line;
  for (std::size_t at = 0; (at = far.find(" 20\n", at)) != std::string::npos; at += 4)
    far.insert(at + 4, "5000");
  for (std::size_t at = 0; (at = far.find(" 21\n", at)) != std::string::npos; at += 4)
    far.insert(at + 4, "5000");
  scratch.write("far.dxf", drawing(far));
  const Scene scene =
      read_in(scratch, generator_scene(R"("dxf": "far.dxf", "joint_sets": [{"dip": 0, "spacing": 0.4}])"));
  REQUIRE(scene.warnings.size() == 1);
  CHECK_THAT(scene.warnings[0],
             Contains("/blocks/0/dxf: no line of ") && Contains("meets the domain") && Contains("in metres"));
}

TEST_CASE("joints and layers beside the domain raise a warning", "[blocks]") {
  const Scratch scratch;
  std::string far = line;
  for (const char* key : {" 20\n", " 21\n"}) far.insert(far.find(key) + 4, "5000");
  scratch.write("two.dxf", drawing(far + old_polyline));
  const Scene scene = read_in(
      scratch,
      generator_scene(
          R"("dxf": "two.dxf", "joints": [{"points": [[0, 0.3], [1, 0.3]]}, {"points": [[2, 2], [3, 3]]}])"));
  const auto told = [&](const char* words) {
    return std::ranges::any_of(
        scene.warnings, [&](const std::string& each) { return each.find(words) != std::string::npos; });
  };
  CHECK(told("/blocks/0/joints/1: this joint lies outside the domain, which goes from"));
  CHECK(told("two.dxf: no line of layer 'fault' meets the domain"));
  CHECK_FALSE(told("'cross'"));
}

TEST_CASE("lines of two names on each other raise a warning", "[blocks]") {
  const Scratch scratch;
  const Scene scene = read_in(scratch, generator_scene(R"("joints": [
      {"points": [[-1, 0.5], [2, 0.5]], "surface": "weak"}, {"points": [[-1, 0.5], [2, 0.5]], "surface": "strong"}])"));
  REQUIRE(scene.warnings.size() == 1);
  CHECK_THAT(scene.warnings[0],
             Contains("'weak' and 'strong' lie on each other: the sides there are of 'weak'"));
}

TEST_CASE("a drawing in another unit than metres raises a warning", "[blocks]") {
  const Scratch scratch;
  for (const auto& [units, said] : {std::pair("4", "joints.dxf: drawn in millimetres ($INSUNITS 4)"),
                                    std::pair("21", "joints.dxf: drawn in US survey feet ($INSUNITS 21)"),
                                    std::pair("6", ""), std::pair("0", "")}) {
    scratch.write("joints.dxf",
                  fmt::format("  0\nSECTION\n  2\nHEADER\n  9\n$INSUNITS\n 70\n{}\n  0\nENDSEC\n", units) +
                      drawing(line));
    const Scene scene = read_in(scratch, generator_scene(R"("dxf": "joints.dxf")"));
    CAPTURE(units);
    REQUIRE(scene.warnings.size() == (*said == 0 ? 0 : 1));
    if (*said != 0) CHECK_THAT(scene.warnings[0], Contains(said));
  }
}

TEST_CASE("a drawing that is absent or broken is a mistake of the scene", "[blocks]") {
  const Scratch scratch;
  scratch.write("bad.dxf", "hello\n");
  for (const auto& [file, said] :
       {std::pair("none.dxf", "there is no file"), std::pair("bad.dxf", "bad.dxf:1: ")}) {
    try {
      read_in(scratch, generator_scene("\"dxf\": \"" + std::string(file) + "\""));
      FAIL("was read");
    } catch (const SceneError& error) {
      REQUIRE(error.mistakes.size() == 1);
      CHECK(error.mistakes[0].pointer == "/blocks/0/dxf");
      CHECK_THAT(error.mistakes[0].message, Contains(said));
    }
  }
}
