#include "safety/safety.hpp"

#include "figures/runs.hpp"
#include "files/input_error.hpp"
#include "safety/mechanism.hpp"
#include "safety/strength.hpp"

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace talus;
using namespace talus::figures;

namespace {

constexpr double degree = std::numbers::pi / 180;

double factor_of(const Scene& scene, double tolerance = 0.01) {
  SafetySettings settings;
  settings.tolerance = tolerance;
  const Safety safety = factor_of_safety(scene, settings);
  REQUIRE(safety.factor());
  CHECK(*safety.falls - *safety.stands <= tolerance * *safety.stands);
  return *safety.factor();
}

constexpr const char* rock_scene = R"({{"talus": 1, "gravity": [0, -9.81],
  "materials": {{"rock": {{"density": 2300, "model": "linear_elastic", "young_modulus": 1e10, "poisson_ratio": 0.2}}}},
  "cover": {{"model": "block"}}, "contact": {{"model": "{0}"}},
  "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e10, "tangential_stiffness": 1e10, "friction_angle": {1},
                  "normal_damping": 0.3, "tangential_damping": 0.3{2}}}],
  "bodies": [{3}], "settle": {{"duration": 0.3, "damping": 20}}, "time": {{"end": 1}}}})";

/// An upper block that slides down 40° and pushes a lower one along 10°; their common face is vertical, and
/// below the upper block's toe there is room.
std::string wedges() {
  const double steep = std::tan(40 * degree), flat = std::tan(10 * degree);
  return fmt::format(
      R"({{"name": "base", "polygon": [[-4, -5], [6, -5], [6, {}], [0, -1], [0, 0], [-4, {}]], "material": "rock", "fixed": true}},
         {{"name": "upper", "polygon": [[-3, {}], [0, 0], [0, 3], [-3, {}]], "material": "rock"}},
         {{"name": "lower", "polygon": [[0, -1], [5, {}], [5, {}], [0, 3]], "material": "rock"}})",
      -1 - 6 * flat, 4 * steep, 3 * steep, 3 * steep + 0.8, -1 - 5 * flat, 1 - 5 * flat);
}

/// Limit equilibrium: at what factor the thrust that the upper block gives is the one that the lower block
/// bears, with friction tan 30°/F on both bases and on the face between them.
double wedge_factor() {
  const double steep = std::tan(40 * degree), flat = std::tan(10 * degree);
  const double upper = 3 * (3 + 0.8) / 2, lower = 5 * (4 + 2) / 2;  // weights, over ρg
  const double s1 = std::sin(40 * degree), c1 = std::cos(40 * degree), s2 = std::sin(10 * degree),
               c2 = std::cos(10 * degree);
  REQUIRE(steep > flat);
  double low = 0.5, high = 4;
  for (int i = 0; i < 60; ++i) {
    const double factor = (low + high) / 2, m = std::tan(30 * degree) / factor;
    const double given = upper * (s1 - m * c1) / (c1 + m * s1 + m * (s1 - m * c1));
    const double borne = lower * (m * c2 - s2) / (c2 + m * s2 - m * (m * c2 - s2));
    (given > borne ? high : low) = factor;
  }
  return low;
}

}  // namespace

TEST_CASE("What still rocks when it has settled stands", "[safety]") {
  // A polygon of 24 sides on a slope of 3°, where its side bears it near an end: it rocks once in some
  // seconds.
  const double slope = -3 * degree, apothem = std::cos(7.5 * degree);
  const auto turned = [&](double x, double y) {
    return fmt::format("[{}, {}]", x * std::cos(slope) - y * std::sin(slope),
                       x * std::sin(slope) + y * std::cos(slope));
  };
  std::string corners;
  for (int i = 0; i < 24; ++i) {
    const double angle = (-82.5 + 15 * i) * degree;
    corners += (i > 0 ? ", " : "") + turned(std::cos(angle), std::sin(angle) + apothem);
  }
  const Scene scene = from_text(fmt::format(
      R"({{"talus": 1, "gravity": [0, -9.81],
        "materials": {{"rock": {{"density": 2500}}}}, "cover": {{"model": "rigid"}},
        "contact": {{"model": "overlap_area"}},
        "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 3e8, "tangential_stiffness": 3e8, "friction_angle": 35,
                        "normal_damping": 0.3, "tangential_damping": 0.3}}],
        "bodies": [{{"name": "base", "polygon": [{}, {}, {}, {}], "material": "rock", "fixed": true}},
                   {{"name": "a", "polygon": [{}], "material": "rock"}}],
        "settle": {{"duration": 1, "damping": 50}}, "time": {{"end": 0.3}}}})",
      turned(-5, -1), turned(5, -1), turned(5, 0), turned(-5, 0), corners));
  CHECK(factor_of(scene) == Approx(std::tan(35 * degree) / std::tan(3 * degree)).epsilon(0.03));
}

TEST_CASE("One block on an incline has the factor of safety tan φ / tan θ", "[safety][slow_sanitised]") {
  for (const char* friction : {"31", "45"}) {
    const Scene scene =
        shipped("stick_31deg", {{"/interfaces/0/friction_angle", friction}, {"/time/end", "1"}});
    CHECK(factor_of(scene) ==
          Approx(std::tan(std::stod(friction) * degree) / std::tan(30 * degree)).epsilon(0.01));
  }
}

TEST_CASE("Two wedges have the factor of limit equilibrium", "[safety][slow_sanitised]") {
  const Scene scene = from_text(fmt::format(fmt::runtime(rock_scene), "overlap_area", 30, "", wedges()));
  const double due = wedge_factor();
  CHECK(due == Approx(1.8234).epsilon(1e-4));
  CHECK(factor_of(scene) == Approx(due).epsilon(0.01));
}

namespace {

/// 35° with friction of 25°: a block that slides into a buttress as far down the slope, in its widths.
Scene above_buttress(double gap) {
  const double c = std::cos(35 * degree), s = std::sin(35 * degree), t = s / c, near = 1 + gap, far = 2 + gap;
  const auto point = [](double x, double y) { return fmt::format("[{}, {}]", x, y); };
  const auto box_on_slope = [&](const char* name, double from, double to, const char* more) {
    return fmt::format(R"({{"name": "{}", "polygon": [{}, {}, {}, {}], "material": "rock"{}}})", name,
                       point(from * c, -from * s), point(to * c, -to * s), point(to * c + s, -to * s + c),
                       point(from * c + s, -from * s + c), more);
  };
  const std::string bodies = fmt::format(
      R"({{"name": "base", "polygon": [[-4, -5], [6, -5], {}, {}], "material": "rock", "fixed": true}}, {}, {})",
      point(6, -6 * t), point(-4, 4 * t), box_on_slope("a", 0, 1, ""),
      box_on_slope("buttress", near, far, R"(, "fixed": true)"));
  return from_text(fmt::format(fmt::runtime(rock_scene), "overlap_area", 25, "", bodies));
}

}  // namespace

TEST_CASE("What slid and came to rest further down has failed", "[safety]") {
  Scene scene = above_buttress(0.5);  // long before the end
  scene.time.end = 3;
  CHECK(factor_of(scene) == Approx(std::tan(25 * degree) / std::tan(35 * degree)).epsilon(0.02));
  const Safety safety = factor_of_safety(scene, {});
  CHECK(std::ranges::any_of(safety.runs, &ReducedRun::stands_again));
  for (const ReducedRun& run : safety.runs) CHECK((run.collapsed || !run.stands_again));
}

TEST_CASE("What stands after a way of its own is told of", "[safety]") {
  const Safety safety = factor_of_safety(above_buttress(0.02), {.highest = 1.1});
  REQUIRE(safety.runs.size() == 1);
  CHECK_FALSE(safety.runs[0].collapsed);
  CHECK(safety.runs[0].came_to_rest == std::vector<std::size_t>{1});
  const Safety leaning = factor_of_safety(above_buttress(0), {.highest = 1.1});
  REQUIRE(leaning.runs.size() == 1);
  CHECK(leaning.runs[0].came_to_rest.empty());
}

TEST_CASE("What cannot stand, and what stands whatever is taken, are told apart", "[safety]") {
  const Safety fallen = factor_of_safety(
      shipped("stick_31deg", {{"/interfaces/0/friction_angle", "1"}, {"/time/end", "1"}}), {.lowest = 0.5});
  CHECK_FALSE(fallen.stands);
  CHECK(fallen.falls);
  CHECK_FALSE(fallen.factor());
  // It slides down 30°: nothing but the block has moved, and the arrow points along the incline.
  const ReducedRun& last = fallen.runs.back();
  REQUIRE(last.parts.size() == 2);
  for (const MovedPart& part : last.parts) {
    for (const MovedPart::Point& point : part.loops.front()) {
      CHECK(point.moved.y ==
            Approx(part.body == 0 ? 0 : -std::tan(30 * degree) * point.moved.x).margin(1e-3));
      CHECK((std::abs(point.moved.x) > 1) == (part.body == 1));
    }
  }
  for (std::size_t i = 0; i + 1 < fallen.runs.size(); ++i) CHECK(fallen.runs[i].parts.empty());
  const std::string flat =
      R"({"name": "base", "polygon": [[-4, -1], [4, -1], [4, 0], [-4, 0]], "material": "rock", "fixed": true},
         {"name": "a", "polygon": [[-1, 0], [1, 0], [1, 1], [-1, 1]], "material": "rock"})";
  const Scene scene = from_text(fmt::format(fmt::runtime(rock_scene), "overlap_area", 30, "", flat));
  const Safety stood = factor_of_safety(scene, {.highest = 3});
  CHECK(stood.stands);
  CHECK_FALSE(stood.falls);
  CHECK(mechanism_svg(scene, stood).empty());
}

TEST_CASE("What makes a factor doubtful is told", "[safety]") {
  const std::string flat =
      R"({"name": "base", "polygon": [[-4, -1], [4, -1], [4, 0], [-4, 0]], "material": "rock", "fixed": true},
         {"name": "a", "polygon": [[-1, 0], [1, 0], [1, 1], [-1, 1]], "material": "rock"})";
  Scene scene = from_text(fmt::format(fmt::runtime(rock_scene), "overlap_area", 30, "", flat));
  CHECK(factor_of_safety(scene, {.highest = 1.1}).warnings.empty());
  scene.settle->duration = 0.001;
  scene.settle->until = 1e-6;
  const std::vector<std::string> unsettled = factor_of_safety(scene, {.highest = 1.1}).warnings;
  REQUIRE(unsettled.size() == 1);
  CHECK_THAT(unsettled[0], Catch::Contains("settling ended with its duration"));

  const Scene yielding = from_text(R"({"talus": 1, "gravity": [0, -10],
      "materials": {"r": {"density": 2000, "model": "mohr_coulomb", "young_modulus": 1e8, "poisson_ratio": 0.25,
                          "friction_angle": 0, "cohesion": 1e6, "dilation_angle": 0}},
      "bodies": [{"name": "a", "material": "r", "polygon": [[0, 0], [2, 0], [2, 2], [0, 2]], "fix": ["y"],
                  "cover": {"model": "hexagonal", "size": 0.7}}],
      "time": {"end": 0.02}, "settle": {"duration": 0.01, "damping": 20}})");
  const std::vector<std::string> locking = factor_of_safety(yielding, {.highest = 1.1}).warnings;
  REQUIRE(locking.size() == 1);
  CHECK_THAT(locking[0], Catch::Contains("lock where they yield") && Catch::Contains("a"));

  const auto bonded = [&](const char* law, const char* bonds) {
    return factor_of_safety(from_text(fmt::format(fmt::runtime(rock_scene), law, 30, bonds, flat)),
                            {.highest = 1.1})
        .warnings;
  };
  for (const char* law : {"vertex_edge", "cohesive_overlap"}) {
    const std::vector<std::string> brittle = bonded(law, R"(, "cohesion": 1e4)");
    REQUIRE(brittle.size() == 1);
    CHECK_THAT(brittle[0], Catch::Contains("lost where it breaks") && Catch::Contains("softening_slip"));
  }
  CHECK(bonded("cohesive_overlap", R"(, "cohesion": 1e4, "softening_slip": 1e-3)").empty());
  // Friction comes long after so little cohesion.
  const std::vector<std::string> late =
      bonded("cohesive_overlap", R"(, "cohesion": 100, "softening_slip": 1.1e-7)");
  REQUIRE(late.size() == 1);
  CHECK_THAT(late[0], Catch::Contains("by what friction is more than cohesion"));
  CHECK(bonded("cohesive_overlap", R"(, "cohesion": 100, "softening_slip": 1e-3)").empty());

  // Against a wall, too, friction is held.
  const auto in_corner = [&](const char* bonds, bool held) {
    Scene corner = from_text(fmt::format(
        fmt::runtime(rock_scene), "cohesive_overlap", 30, bonds,
        R"({"name": "base", "polygon": [[-4, 4], [-4, -1], [4, -1], [4, 0], [-1, 0], [-1, 4]], "material": "rock",
            "fixed": true}, {"name": "a", "polygon": [[-1, 0], [1, 0], [1, 1], [-1, 1]], "material": "rock"})"));
    corner.gravity = {-1, -10};
    corner.settle->hold_stick = held;
    return factor_of_safety(corner, {.highest = 1.1}).warnings;
  };
  const char* soft = R"(, "cohesion": 1e4, "softening_slip": 1e-3)";
  const std::vector<std::string> held = in_corner(soft, true);
  REQUIRE(held.size() == 1);
  CHECK_THAT(held[0],
             Catch::Contains("'a' stands on several faces") && Catch::Contains("/settle/hold_stick"));
  CHECK(in_corner(soft, false).empty());
  CHECK(in_corner("", true).empty());

  // A bond that pulls is no second face.
  Scene hung = from_text(fmt::format(
      fmt::runtime(rock_scene), "cohesive_overlap", 30,
      R"(, "cohesion": 1e5, "tensile_strength": 1e6, "softening_slip": 1e-2)",
      R"({"name": "wall", "polygon": [[-4, 4], [-4, -1], [-1, -1], [-1, 4]], "material": "rock", "fixed": true},
         {"name": "a", "polygon": [[-1, 0], [1, 0], [1, 1], [-1, 1]], "material": "rock"})"));
  for (const std::string& warning : factor_of_safety(hung, {.highest = 1.1}).warnings)
    CHECK_THAT(warning, !Catch::Contains("several faces"));
}

TEST_CASE("A bonded scene that slides while it settles has its factor below 1", "[safety]") {
  const double slope = 35 * degree, factor = 0.9, weight = 2300 * 9.81 * 2;
  const double cohesion = (factor * std::sin(slope) - std::tan(30 * degree) * std::cos(slope)) * weight / 2;
  Scene scene = from_text(fmt::format(
      fmt::runtime(rock_scene), "cohesive_overlap", 30,
      fmt::format(R"(, "cohesion": {}, "softening_slip": 1e-3)", cohesion),
      R"({"name": "base", "polygon": [[-4, -1], [4, -1], [4, 0], [-4, 0]], "material": "rock", "fixed": true},
         {"name": "a", "polygon": [[-1, 0], [1, 0], [1, 1], [-1, 1]], "material": "rock"})"));
  scene.gravity = {-9.81 * std::sin(slope), -9.81 * std::cos(slope)};
  scene.settle->hold_stick = false;
  const Safety safety = factor_of_safety(scene, {});
  REQUIRE(safety.factor());
  CHECK(*safety.factor() == Approx(factor).epsilon(0.02));
}

TEST_CASE("Strength is that of interfaces and of materials, and a scene without any is refused", "[safety]") {
  const Scene scene = shipped("stick_31deg");
  const Scene reduced = with_reduced_strength(scene, 2);
  const std::size_t phi = 2;  // friction_angle of overlap_area
  CHECK(std::tan(reduced.interface_values[0][phi]) == Approx(std::tan(scene.interface_values[0][phi]) / 2));
  CHECK_THROWS_AS(with_reduced_strength(shipped("collision", {{"/interfaces/0/friction_angle", "0"}}), 2),
                  InputError);
}

TEST_CASE("A material dilates no more than its reduced friction allows", "[safety]") {
  const Scene scene =
      from_text(R"({"talus": 1, "materials": {"rock": {"density": 2300, "model": "mohr_coulomb",
      "young_modulus": 1e8, "poisson_ratio": 0.25, "friction_angle": 30, "cohesion": 1e4, "dilation_angle": 20}},
      "contact": {"model": "frictionless"},
      "interfaces": [{"between": ["*", "*"], "normal_stiffness": 1e9, "normal_damping": 0}],
      "bodies": [{"name": "a", "polygon": [[0, 0], [1, 0], [1, 1], [0, 1]], "material": "rock"}],
      "time": {"end": 1}})");
  const auto values = [](const Scene& of, const char* key) {
    const SceneMaterial& material = of.materials[0];
    const Component& component = *material.model.component->component;
    for (std::uint32_t i = 0; i < component.parameter_count; ++i) {
      if (std::string(component.parameters[i].key) == key) return material.model.values[i];
    }
    return -1.0;
  };
  const Scene little = with_reduced_strength(scene, 1.2), much = with_reduced_strength(scene, 2);
  CHECK(values(little, "dilation_angle") == values(scene, "dilation_angle"));
  CHECK(values(much, "dilation_angle") == values(much, "friction_angle"));
  CHECK(values(much, "friction_angle") == Approx(std::atan(std::tan(30 * degree) / 2)));
}

TEST_CASE("What sinks while it settles with less strength has failed", "[safety]") {
  // A block of 2 m under its weight yields from a factor of 1.5 on, 2 c / (ρ g h / 2), and finds rest again
  // once it is wide enough: from 1.575 on it sinks by a twentieth of its width for that.
  const Scene scene = from_text(R"({"talus": 1, "gravity": [0, -10],
      "materials": {"r": {"density": 2000, "model": "mohr_coulomb", "young_modulus": 1e8, "poisson_ratio": 0.25,
                          "friction_angle": 0, "cohesion": 15000, "dilation_angle": 0}, "s": {"density": 2000}},
      "contact": {"model": "overlap_area"},
      "interfaces": [{"between": ["*", "*"], "normal_stiffness": 1e10, "tangential_stiffness": 1e10,
                      "friction_angle": 0, "normal_damping": 0.3, "tangential_damping": 0.3}],
      "bodies": [{"name": "base", "material": "s", "fixed": true, "polygon": [[-6, -1], [8, -1], [8, 0], [-6, 0]]},
                 {"name": "a", "material": "r", "polygon": [[0, 0], [2, 0], [2, 2], [0, 2]], "cover": {"model": "block"}}],
      "damping": 20, "time": {"end": 1}, "settle": {"duration": 2, "damping": 20}})");
  CHECK(factor_of(scene, 0.02) == Approx(1.575).epsilon(0.02));
}

namespace {

/// A block of side `size` on a plane of 35° with friction of 45°.
Scene on_a_plane(double size, const std::vector<Override>& overrides = {}, const std::string& more = "") {
  const double c = std::cos(35 * degree), s = std::sin(35 * degree), t = s / c;
  const auto point = [&](double x, double y) { return fmt::format("[{}, {}]", size * x, size * y); };
  return from_text(
      fmt::format(fmt::runtime(rock_scene), "overlap_area", 45, "",
                  fmt::format(
                      R"({{"name": "base", "polygon": [{}, {}, {}, {}], "material": "rock", "fixed": true}},
             {{"name": "a", "polygon": [{}, {}, {}, {}], "material": "rock", "cover": {{"model": "rigid"}}}}{})",
                      point(-4, -8), point(8, -8), point(8, -8 * t), point(-4, 4 * t), point(0, 0),
                      point(c, -s), point(c + s, c - s), point(s, c), more)),
      overrides);
}

const double on_a_plane_due = 1 / std::tan(35 * degree);

}  // namespace

TEST_CASE("What slides at a steady speed has failed", "[safety]") {
  for (const char* damping : {"30", "300"})
    CHECK(factor_of(on_a_plane(1, {{"/damping", damping}})) == Approx(on_a_plane_due).epsilon(0.015));
}

TEST_CASE("What creeps against damping is put to sleep by no scene", "[safety]") {
  CHECK(factor_of(on_a_plane(1, {{"/damping", "100"}, {"/sleep", R"({"speed": 1e-2})"}})) ==
        Approx(on_a_plane_due).epsilon(0.015));
}

TEST_CASE("A factor that damping makes too high says so, and for how long to run", "[safety]") {
  const auto told = [](const char* damping) {
    const Safety safety =
        factor_of_safety(on_a_plane(1, {{"/damping", damping}, {"/interfaces/0/friction_angle", "30"}}), {});
    return std::ranges::count_if(safety.warnings, [](const std::string& warning) {
      return warning.starts_with("runs of up to") && warning.find("where /damping") != std::string::npos;
    });
  };
  CHECK(told("1") == 0);
  CHECK(told("1e4") == 1);
}

TEST_CASE("A factor depends neither on the size of a block nor on the time it is given", "[safety]") {
  CHECK(factor_of(on_a_plane(50)) == Approx(on_a_plane_due).epsilon(0.015));
  CHECK(factor_of(on_a_plane(1, {{"/time/end", "0.05"}})) == Approx(on_a_plane_due).epsilon(0.015));
}

TEST_CASE("What follows a load that grows to the end has not failed, and no load grows on after it",
          "[safety]") {
  const auto scene = [](const char* end, const char* load) {
    return from_text(
        fmt::format(
            fmt::runtime(rock_scene), "overlap_area", 30, "",
            R"({"name": "base", "polygon": [[-4, -1], [6, -1], [6, 0], [-4, 0]], "material": "rock", "fixed": true},
         {"name": "a", "polygon": [[0, 0], [2, 0], [2, 1], [0, 1]], "material": "rock", "cover": {"model": "rigid"}})"),
        {{"/interfaces/0/normal_stiffness", "1e8"},
         {"/interfaces/0/tangential_stiffness", "1e8"},
         {"/time/end", end},
         {"/loads", load}});
  };
  // Pressed down by 3 mm it stands whatever its friction.
  for (const char* end : {"1", "1.25", "1.5"}) {
    INFO("ends at " << end);
    SafetySettings settings;
    settings.highest = 3;
    const Safety pressed = factor_of_safety(
        scene(
            end,
            R"([{"body": "a", "point": [1, 0.5], "force": [0, [{"scale": -6e5, "time": [[0, 0], [1, 1]]}]]}])"),
        settings);
    CHECK(pressed.stands.value_or(0) > 2);
    CHECK_FALSE(pressed.falls);
  }
  // Pushed by 10 kN at the end of the run, by 40 kN had it gone on.
  const double weight = 2 * 2300 * 9.81;
  CHECK(
      factor_of(scene(
          "1",
          R"([{"body": "a", "point": [1, 0.3], "force": [[{"scale": 4e4, "time": [[0, 0], [4, 1]]}], 0]}])")) ==
      Approx(weight * std::tan(30 * degree) / 1e4).epsilon(0.015));
}

TEST_CASE("What slides while it settles with less strength is told by how it goes on", "[safety]") {
  const char* settle = R"({"duration": 2, "damping": 50, "hold_stick": false})";
  const auto scene = [&] { return on_a_plane(1, {{"/time/end", "0.05"}, {"/settle", settle}}); };
  CHECK(factor_of(scene()) == Approx(on_a_plane_due).epsilon(0.015));
}

TEST_CASE("Safety says which body fell while the scene settled with its full strength", "[safety]") {
  const auto told = [](const char* gravity) {
    const char* settle = R"({"duration": 0.5, "damping": 5, "hold_stick": false})";
    const Scene scene = on_a_plane(1, {{"/time/end", "0.05"}, {"/settle", settle}, {"/gravity", gravity}});
    return std::ranges::any_of(
        factor_of_safety(scene, {.highest = 1.1}).warnings, [](const std::string& warning) {
          return warning.starts_with("with its full strength") && warning.ends_with(": a");
        });
  };
  CHECK(told("[6, -9.81]"));  // as if the plane stood at 66°
  CHECK_FALSE(told("[0, -9.81]"));
}

TEST_CASE("Runs that are too short to see a body fail are told of, with the time it takes", "[safety]") {
  const auto warnings_at = [](const char* end) {
    return factor_of_safety(on_a_plane(50, {{"/time/end", end}}), {.highest = 1.1}).warnings;
  };
  // √(2 · 50 m / 1000 / (0.01 g)) = 1.0 s, an eighth of which and some more.
  const std::vector<std::string> warnings = warnings_at("0.05");
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0],
             Catch::Contains("up to 0.4 s are too short") && Catch::Contains("/time/end of 0.14 s at least"));
  CHECK(warnings_at("0.14").empty());
}

TEST_CASE("Drives and velocities at the start are no collapse", "[safety]") {
  const std::string far =
      R"(, {"name": "far", "material": "rock", "polygon": [[50, 0], [51, 0], [51, 1], [50, 1]], )";
  CHECK(factor_of(on_a_plane(1, {}, far + R"("drive": {"x": 1, "y": 0.2, "rotation": 0}})")) ==
        Approx(on_a_plane_due).epsilon(0.015));
  CHECK(factor_of(on_a_plane(1, {{"/bodies/1/velocity", "[0.5, -0.3]"}})) ==
        Approx(on_a_plane_due).epsilon(0.015));
}

TEST_CASE("A run goes on until it tells, and what moves on too slowly for that is named", "[safety]") {
  const auto run_of = [](double beyond) {
    Scene scene = on_a_plane(1, {{"/time/end", "0.05"}});
    scene.interface_values[0][2] = std::atan(std::tan(35 * degree) / beyond);
    SafetySettings settings;
    settings.lowest = settings.highest = 1;
    const Safety safety = factor_of_safety(scene, settings);
    REQUIRE(safety.runs.size() == 1);
    return safety.runs[0];
  };
  // g sin 35° times what is missing, over 0.05 and 0.4 s: 7 µm, and 1.4 mm of a width of 1 m.
  const ReducedRun little = run_of(1.001);
  CHECK_FALSE(little.collapsed);
  CHECK(little.lasted == Approx(0.05));
  CHECK(little.moving_little == std::vector<std::size_t>{1});
  const ReducedRun more = run_of(1.003);
  CHECK(more.collapsed);
  CHECK(more.lasted == Approx(0.4));
  CHECK(more.moving_little.empty());
}

TEST_CASE("A block that a joint cuts out of a body is followed", "[safety][slow_sanitised]") {
  // It stands on the floor of an opening, which dips 35°; its corners are the opening's, none is of the
  // outline.
  const double c = std::cos(35 * degree), s = std::sin(35 * degree);
  const auto point = [&](double along, double up) {
    return fmt::format("[{}, {}]", along * c + up * s, up * c - along * s);
  };
  const std::string opening =
      fmt::format("[{}, {}, {}, {}, {}, {}, {}, {}]", point(-2, 0), point(-0.5, 0), point(-0.5, 1),
                  point(0.5, 1), point(0.5, 0), point(2, 0), point(2, 2), point(-2, 2));
  const Scene scene = from_text(fmt::format(
      R"({{"talus": 1, "gravity": [0, -9.81],
    "materials": {{"rock": {{"density": 2300, "model": "linear_elastic", "young_modulus": 1e10, "poisson_ratio": 0.2}}}},
    "cover": {{"model": "hexagonal", "size": 0.8}}, "contact": {{"model": "overlap_area"}},
    "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e10, "tangential_stiffness": 1e10,
                    "friction_angle": 45, "normal_damping": 0.3, "tangential_damping": 0.3}}],
    "bodies": [{{"name": "a", "material": "rock", "polygon": [[-4, -4], [4, -4], [4, 4], [-4, 4]],
                "surfaces": {{"foot": [0]}}, "holes": [{}], "discontinuities": [{{"points": [{}, {}]}}]}}],
    "prescribed": [{{"body": "a", "surface": "foot", "displacement": [0, 0], "stiffness": 1e11}}],
    "settle": {{"duration": 0.2, "damping": 100}}, "time": {{"end": 0.5}}}})",
      opening, point(-0.5, 0), point(0.5, 0)));
  CHECK(factor_of(scene, 0.02) == Approx(on_a_plane_due).epsilon(0.02));
}

TEST_CASE("That a run with more strength was stopped is no collapse, whatever those with less did",
          "[safety]") {
  const auto run = [](double factor, const char* trouble) {
    ReducedRun one;
    one.factor = factor;
    one.collapsed = true;
    one.trouble = trouble;
    return one;
  };
  const ReducedRun slides = run(1, ""), stops = run(0.8, "a step too long"), last = run(0.64, "no balance");
  CHECK_THAT(
      trouble_of_runs({slides, stops, last}),
      Catch::Contains("1.25 to 1.56 times the strength are all stopped") && Catch::EndsWith("no balance"));
  CHECK_THAT(trouble_of_runs({run(1, "odd"), stops}), Catch::Contains("with 1 to 1.25 times"));
  CHECK(trouble_of_runs({slides, stops, run(0.64, "")}).empty());
  CHECK(trouble_of_runs({}).empty());
}
