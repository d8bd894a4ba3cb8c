#include "scene/sample.hpp"
#include "scene/tables.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <numbers>
#include <span>
#include <string_view>

using namespace talus;
using sample::interface_row;

namespace {

constexpr double degree_in_rows = std::numbers::pi / 180;

/// The ramp (steel, surfaces "top" and "" ) and two blocks of rock, each with a surface "base".
std::string with_rows(const std::string& rows) {
  return R"({"talus": 1, "materials": {"rock": {"density": 1}, "steel": {"density": 1}}, "time": {"end": 1},
    "cover": {"model": "rigid"}, "contact": {"model": "shear"},
    "bodies": [
      {"name": "ramp", "polygon": [[0, 0], [8, 0], [8, 1], [0, 1]], "material": "steel", "fixed": true, "surfaces": {"top": [2]}},
      {"name": "a", "polygon": [[1, 1], [2, 1], [2, 2], [1, 2]], "material": "rock", "surfaces": {"base": [0]}},
      {"name": "b", "polygon": [[3, 1], [4, 1], [4, 2], [3, 2]], "material": "rock", "surfaces": {"base": [0]}}
    ], "interfaces": [)" +
         rows + "]}";
}

/// Friction angle in degrees between an edge of one body and an edge of another.
double angle(const Scene& scene, std::size_t body, std::size_t edge, std::size_t other,
             std::size_t other_edge) {
  const std::uint32_t i = scene.bodies[body].outer.surface_class[edge],
                      j = scene.bodies[other].outer.surface_class[other_edge];
  const std::size_t count = scene.surfaces.size();
  CHECK(scene.interface_row[i * count + j] == scene.interface_row[j * count + i]);
  return scene.interface_values[scene.interface_row[i * count + j]][1] / degree_in_rows;
}

}  // namespace

TEST_CASE("the more specific row wins, whatever the order of rows and sides", "[scene]") {
  const std::vector<std::string> rows{interface_row("*", "*", 1),        interface_row("rock", "*", 2),
                                      interface_row("steel", "rock", 3), interface_row("top", "rock", 4),
                                      interface_row("base", "top", 5),   interface_row("rock", "rock", 6)};
  for (const bool reversed : {false, true}) {
    std::string all;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      all += (i == 0 ? "" : ",\n") + rows[reversed ? rows.size() - 1 - i : i];
    }
    const Scene scene = sample::read(with_rows(all));
    CHECK(angle(scene, 0, 2, 1, 0) == Approx(5));  // top, base
    CHECK(angle(scene, 0, 2, 1, 1) == Approx(4));  // top, rock
    CHECK(angle(scene, 0, 0, 1, 1) == Approx(3));  // steel, rock
    CHECK(angle(scene, 1, 1, 2, 3) == Approx(6));  // rock, rock
  }
}

TEST_CASE("a row with one * comes before a row with two", "[scene]") {
  const Scene scene =
      sample::read(with_rows(interface_row("*", "*", 1) + "," + interface_row("*", "top", 2)));
  CHECK(angle(scene, 0, 2, 1, 0) == Approx(2));
  CHECK(angle(scene, 0, 0, 1, 0) == Approx(1));
}

TEST_CASE("body/surface limits a row to one body", "[scene]") {
  const Scene scene =
      sample::read(with_rows(interface_row("*", "*", 1) + "," + interface_row("base", "top", 2) + "," +
                             interface_row("top", "b/base", 3)));
  CHECK(angle(scene, 0, 2, 1, 0) == Approx(2));
  CHECK(angle(scene, 0, 2, 2, 0) == Approx(3));
}

TEST_CASE("surface classes are the distinct pairs of material and surface, in the order of the edges",
          "[scene]") {
  const Scene scene = sample::read(with_rows(interface_row("*", "*", 1)));
  REQUIRE(scene.surfaces.size() == 4);
  CHECK((scene.surfaces[0].material == "steel" && scene.surfaces[0].surface.empty()));
  CHECK((scene.surfaces[1].material == "steel" && scene.surfaces[1].surface == "top"));
  CHECK((scene.surfaces[2].material == "rock" && scene.surfaces[2].surface == "base"));
  CHECK((scene.surfaces[3].material == "rock" && scene.surfaces[3].surface.empty()));
  CHECK(scene.bodies[0].outer.surface_class == std::vector<std::uint32_t>{0, 0, 1, 0});
  CHECK(scene.bodies[2].outer.surface_class == std::vector<std::uint32_t>{2, 3, 3, 3});
}

TEST_CASE("pairs that cannot meet need no row", "[scene]") {
  // The two fixed sides of the ramp never meet; rock meets rock and steel.
  CHECK(
      sample::mistakes(with_rows(interface_row("rock", "rock", 1) + "," + interface_row("rock", "steel", 2)))
          .empty());
  CHECK(sample::mistakes(with_rows(interface_row("rock", "steel", 2))).size() ==
        3);  // base–base, base–rock, rock–rock
}

TEST_CASE("a row that holds for nothing that can meet is told", "[scene]") {
  // The surface "top" is of fixed steel alone; of the two rows for rock the more specific one holds.
  const auto warnings = [](const std::string& rows) { return sample::read(with_rows(rows)).warnings; };
  const std::string all = interface_row("*", "*", 1);
  CHECK(warnings(all).empty());
  const std::vector<std::string> idle = warnings(all + "," + interface_row("steel", "steel", 2));
  REQUIRE(idle.size() == 1);
  CHECK_THAT(idle[0], Catch::Contains("/interfaces/1 never applies"));
  // One for the rest may find nothing left.
  CHECK(warnings(all + "," + interface_row("rock", "*", 2) + "," + interface_row("rock", "rock", 3)).empty());
  CHECK(warnings(interface_row("rock", "rock", 1) + "," + interface_row("rock", "steel", 2) + "," +
                 interface_row("steel", "*", 3))
            .size() == 1);
}

TEST_CASE("parameters that the chosen law does not read are accepted, and told", "[scene]") {
  ReadOptions smooth{{{"/contact/model", "smooth"}}, false};
  const Scene scene = sample::read(sample::good, smooth);
  CHECK(scene.interface_values[0] == std::vector<double>{1e10, 0.3});
  CHECK(scene.warnings == std::vector<std::string>{"/interfaces: smooth reads no friction_angle"});
  smooth.overrides.push_back({"/interfaces/0/friction_angle", "0"});
  smooth.overrides.push_back({"/interfaces/0/tangential_stiffness", "0"});
  CHECK(sample::read(sample::good, smooth).warnings.empty());
}

TEST_CASE("a row may hold keys of a law that the scene can be varied over", "[scene]") {
  const std::string text =
      sample::good_but("\"normal_damping\": 0.3", "\"normal_damping\": 0.3, \"dilation\": 1");
  CHECK(sample::mistakes(text, {{{"/contact/model", "smooth"}}, false}).empty());
  const std::vector<Mistake> mistakes =
      sample::mistakes(text, {{{"/contact", "{\"model\": \"smooth\"}"}}, false});
  REQUIRE(mistakes.size() == 1);
  CHECK_THAT(mistakes[0].message, Catch::Contains("'shear' does") && Catch::Contains("\"shear\": {}"));
}

TEST_CASE("fixed bodies alone need no contact", "[scene]") {
  const Scene scene =
      sample::read(sample::good_but("\"material\": \"rock\"", "\"material\": \"rock\", \"fixed\": true"),
                   {{{"/loads", "[]"}}, false});
  CHECK(scene.contact.component == nullptr);
}

TEST_CASE("the vocabulary has the units and ranges of the laws that come along", "[scene]") {
  Registry installed;
  load_folders(installed, std::array{std::filesystem::path(TALUS_PLUGINS)});
  std::size_t compared = 0;
  for (const RegisteredComponent& entry : installed.components()) {
    const Component& law = *entry.component;
    for (const Parameter& read : std::span(law.interface_parameters, law.interface_parameter_count)) {
      for (const Parameter& known : table::interface) {
        if (std::string_view(known.key) != read.key) continue;
        CAPTURE(law.name, read.key);
        CHECK(std::string_view(known.unit) == read.unit);
        CHECK(known.minimum == read.minimum);
        CHECK(known.maximum == read.maximum);
        ++compared;
      }
    }
  }
  CHECK(compared >= 10);
}
