#include "files/input_error.hpp"
#include "files/whole_file.hpp"
#include "output/recorded_run.hpp"
#include "output/scratch.hpp"
#include "picture/chart.hpp"
#include "picture/marks.hpp"
#include "picture/palette.hpp"
#include "picture/scene_picture.hpp"
#include "picture/section.hpp"
#include "report/figures.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <cmath>
#include <limits>
#include <regex>
#include <sstream>

using namespace talus;
using Catch::Matchers::Contains;

namespace {

/// Throws where the text is no well-formed XML.
void check_xml(const std::string& text) {
  std::istringstream stream(text);
  boost::property_tree::ptree tree;
  CHECK_NOTHROW(boost::property_tree::read_xml(stream, tree));
  CHECK(tree.count("svg") == 1);
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

}  // namespace

TEST_CASE("Ticks are round numbers within their range", "[picture]") {
  CHECK(ticks(0, 10) == std::vector<double>{0, 2, 4, 6, 8, 10});
  CHECK(ticks(-1, 1).front() == -1);
  CHECK(ticks(-0.1, 5).front() == 0);
  for (const double size : {1e-12, 3.7e-4, 0.9, 42.0, 7e9}) {
    const std::vector<double> found = ticks(-size, size / 3);
    CAPTURE(size);
    CHECK(found.size() >= 3);
    CHECK(found.size() <= 9);
    CHECK(found.front() >= -size * (1 + 1e-9));
    CHECK(found.back() <= size / 3 * (1 + 1e-9));
  }
}

TEST_CASE("A chart is well-formed, breaks where there is no number, and says what its curves are",
          "[picture]") {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  const std::string svg =
      chart_svg("a < b & c", "t [s]", "v [m/s]",
                {{"one", {0, 1, 2, 3, 4}, {0, 1, nothing, 1, 2}, 0, ""}, {"two", {0, 4}, {5, 5}, 1, "3 3"}});
  check_xml(svg);
  CHECK_THAT(svg,
             Contains("a &lt; b &amp; c") && Contains("t [s]") && Contains(">one<") && Contains(">two<"));
  CHECK(count(svg, "stroke=\"#0b6bcb\"") == 3);  // two stretches and the legend
  check_xml(chart_svg("nothing", "t [s]", "v", {}));
  // A legend for all, in as many lines as it takes, and a picture that holds them.
  const std::string name(40, 'n');
  std::vector<Curve> many;
  for (std::size_t i = 0; i < 5; ++i) many.push_back({name + std::to_string(i), {0, 1}, {0, 1}, i, ""});
  const std::string high = chart_svg("many", "t [s]", "v", many);
  check_xml(high);
  for (std::size_t i = 0; i < 5; ++i) CHECK_THAT(high, Contains(name + std::to_string(i)));
  CHECK_THAT(high, Contains("height=\"432\""));
}

TEST_CASE("A chart has room for numbers far from zero, and values a rounding apart are a level line",
          "[picture]") {
  const std::string far =
      chart_svg("far", "t [s]", "y", {{"y", {0, 1}, {5400000.9558, 5400000.9562}, 0, ""}});
  check_xml(far);
  const std::regex beside("x=\"([0-9.]+)\"[^>]*text-anchor=\"end\">([^<]*)<");
  std::size_t numbers = 0;
  for (std::sregex_iterator at(far.begin(), far.end(), beside); at != std::sregex_iterator(); ++at, ++numbers)
    CHECK(std::stod((*at)[1]) - 6.5 * static_cast<double>((*at)[2].length()) > 24);  // right of the title
  CHECK(numbers >= 3);
  check_xml(
      chart_svg("ulp", "t [s]", "y", {{"y", {0, 1}, {0.49993312593742345, 0.4999331259374235}, 0, ""}}));
}

TEST_CASE("Marks stand over axes by powers of ten and leave out what these cannot show", "[picture]") {
  const std::vector<Mark> marks{{1e-3, 1, "one", "the < first", "#0b6bcb"},
                                {1e3, 10, "two", "", "#0b6bcb"},
                                {1, 0, "naught", "", "#0b6bcb"},
                                {1, 100, "", "", "#d9480f"}};
  const std::string svg = marks_svg("a & b", "cost", "error", marks, {{{0, 1}, "#2b8a3e", "6 3", "front"}});
  check_xml(svg);
  CHECK(count(svg, "<circle") == 3);
  CHECK_THAT(svg, Contains("<title>the &lt; first</title>") && Contains(">one<") && Contains(">two<") &&
                      Contains(">front<") && !Contains("naught") &&
                      Contains("1 of 4 not drawn: no number above 0"));
  CHECK(power_ticks(0.9, 22) == std::vector<double>{1, 2, 5, 10, 20});
  CHECK(power_ticks(3.5, 8) == std::vector<double>{4, 5, 7});
  CHECK(power_ticks(0.9e-3, 1100) == std::vector<double>{1e-3, 1e-2, 0.1, 1, 10, 100, 1000});
  check_xml(marks_svg("nothing", "x", "y", {{0, 0, "", "", ""}}, {}));
  std::vector<MarkLine> many;
  for (int i = 0; i < 9; ++i)
    many.push_back({{0, 1}, "#2b8a3e", "", "friction_angle = " + std::to_string(i)});
  const std::string high = marks_svg("many", "x", "y", marks, many);
  check_xml(high);
  for (const MarkLine& line : many) CHECK_THAT(high, Contains(">" + line.label + "<"));
}

TEST_CASE("Colours go from dark to light, and what lies outside of the range has the colour of its end",
          "[picture]") {
  CHECK(palette::shade(0) == "#440154");
  CHECK(palette::shade(1) == "#fde725");
  CHECK(palette::shade(-3) == palette::shade(0));
  CHECK(palette::shade(std::numeric_limits<double>::quiet_NaN()) == palette::shade(0));
}

TEST_CASE("A section shows all points at one scale", "[picture]") {
  const SectionView view({{-3, 5}, {7, 9}}, 1000);
  for (const Vec2 point : {Vec2{-3, 5}, Vec2{7, 9}, Vec2{0, 6}}) {
    const Spot at = view.at(point);
    CHECK(at.x >= 0);
    CHECK(at.x <= view.width());
    CHECK(at.y >= 0);
    CHECK(at.y <= view.height());
  }
  CHECK(view.at({1, 5}).x - view.at({0, 5}).x == Approx(view.at({0, 5}).y - view.at({0, 6}).y));
  const SectionView far({{5e5, 5e6}, {5e5, 5e6 + 1e-3}}, 1000);
  CHECK(far.at({5e5, 5e6}).y - far.at({5e5, 5e6 + 1e-3}).y > 50);
}

TEST_CASE("The picture of a scene shows what it is made of", "[picture]") {
  WorkingScene text;
  text.gravity = "[0, -9.81]";
  text.cover = "block";
  text.bodies = box("base", -4, -2, 4, 0, R"("fixed": true)") + "," +
                box("a", -1, 0, 1, 2, R"("surfaces": {"top": [2]}, "velocity": [3, 0])") + "," +
                box("b", 2, 0, 4, 2, R"("fix": ["rotation"])");
  text.rest = R"("loads": [{"body": "b", "point": [3, 2], "force": [0, -1e3]}],
                 "surface_loads": [{"body": "a", "surface": "top", "pressure": 1e3}],)";
  const std::string svg = scene_svg(Simulation(text.read(), {}));
  check_xml(svg);
  for (const char* words :
       {">base<", ">a<", ">b<", "surface top", "velocity, the longest 3 m/s", "rotation held", ">load<",
        "traction, pressure, the longest 1e+03 Pa", "<title>a</title></path>", "9.81 m/s²"}) {
    CHECK_THAT(svg, Contains(words));
  }
}

TEST_CASE("The picture of a scene marks what holds, drives, moves and drains its bodies", "[picture]") {
  WorkingScene text;
  text.bodies = box("base", -4, -2, 8, 0, R"("fixed": true)") + "," +
                box("held", -3, 0, -2, 1, R"("fix": ["x"])") + "," +
                box("driven", 0, 0, 1, 1, R"("drive": {"y": -0.5})") + "," +
                // Its middle is in the notch, where its name would not be within it.
                R"({"name": "notched", "material": "rock", "cover": {"model": "hexagonal", "size": 0.5},
                    "polygon": [[3, 0], [6, 0], [6, 3], [5.9, 3], [5.9, 0.1], [3, 0.1]],
                    "surfaces": {"right": [1], "under": [0]}})";
  text.rest =
      R"("prescribed": [{"body": "notched", "surface": "under", "stiffness": 1e10, "velocity": [0, 1]}],
                 "absorbing": [{"body": "notched", "surface": "right"}],)";
  const std::string svg = scene_svg(Simulation(text.read(), {}));
  check_xml(svg);
  for (const char* words : {"held along the bar", ">driven<", "prescribed motion", ">absorbing<",
                            "surface right", "surface under", ">notched<"}) {
    CHECK_THAT(svg, Contains(words));
  }
  // Elements of the covered body, each a faint outline without a fill; the others have one element each.
  const auto count = [&](const std::string& words) {
    std::size_t found = 0;
    for (std::size_t at = svg.find(words); at != std::string::npos; at = svg.find(words, at + 1)) ++found;
    return found;
  };
  CHECK(count("fill=\"none\"") >= 10);
}

TEST_CASE("The name of a body stands in it and not in its hole", "[picture]") {
  WorkingScene text;
  text.bodies = R"({"name": "frame", "material": "rock", "polygon": [[0, 0], [4, 0], [4, 4], [0, 4]],
                    "holes": [[[1, 0.5], [3, 0.5], [3, 3.5], [1, 3.5]]]})" +
                ("," + box("core", 1.5, 1, 2.5, 3, R"("fixed": true)"));
  const std::string svg = scene_svg(Simulation(text.read(), {}));
  check_xml(svg);
  const auto x_of = [&](const std::string& name) {
    std::smatch found;
    REQUIRE(std::regex_search(svg, found, std::regex("<text x=\"([0-9.]+)\"[^>]*>" + name + "<")));
    return std::stod(found[1]);
  };
  // Its middle is that of the core, 1.5 m from the middles of its sides; the picture of 4 m is 1000 wide at
  // most.
  CHECK(std::abs(x_of("frame") - x_of("core")) > 200);
}

TEST_CASE("Figures of a run are drawn from its files", "[picture]") {
  const Scratch scratch;
  CHECK_THROWS_WITH(write_figures(scratch.folder()), Contains("no folder of results"));
  WorkingScene text;
  text.gravity = "[0, -10]";
  text.bodies = box("base", -4, -2, 4, 0, R"("fixed": true)") + "," + box("block", 0, 0.001, 1, 1.001);
  text.time = R"({"end": 0.1})";
  text.output = R"({"history": 0.01, "frames": 0.05})";
  Scene scene = text.read();
  scene.monitors.push_back({"m", 1, std::nullopt, {"speed", "uy"}});
  RunOrder order;
  order.folder = scratch.folder();
  Simulation simulation(std::move(scene), {});
  record_run(simulation, order);
  const auto files = write_figures(scratch.folder());
  std::vector<std::string> names;
  for (const auto& file : files) {
    names.push_back(file.filename().string());
    check_xml(read_whole_file(file));
  }
  CHECK(names == std::vector<std::string>{"speed.svg", "uy.svg", "contact_forces.svg", "energy.svg",
                                          "first_state.svg", "last_state.svg"});
}
