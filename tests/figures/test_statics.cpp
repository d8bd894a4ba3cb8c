#include "figures/runs.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

using namespace talus;
using namespace talus::figures;

TEST_CASE("Column: the top settles by its joints and its blocks, and by nothing else", "[figures]") {
  // rho g h/alpha n(n+1)/2 and rho g h² (1 − nu²)/E (n²/2 − 1/4), n = 10.
  const double joints = 2300 * 10 / 1e10 * 55;
  const double blocks = 2300 * 10 * (1 - 0.0625) / 1e10 * (50 - 0.25);
  for (const std::string law : {"overlap_area", "frictionless", "vertex_edge"}) {
    const Course course = run(shipped("column", {{"/contact/model", law}}), "b10");
    const Motion& last = course.motion.back();
    INFO(fmt::format("{}: {:.6e} of {:.6e} m, aside {:.1e} m, speed {:.1e} m/s", law, -last.displacement.y,
                     joints + blocks, last.displacement.x, std::hypot(last.velocity.x, last.velocity.y)));
    CHECK(-last.displacement.y == Approx(joints + blocks).epsilon(law == "vertex_edge" ? 0.08 : 0.01));
    CHECK(std::abs(last.displacement.x) < 1e-12);
    CHECK(std::abs(last.rotation) < 1e-12);
    CHECK(std::hypot(last.velocity.x, last.velocity.y) < 1e-6);
  }
}

TEST_CASE("Brick wall: at rest before 1 s, settled as its header says, left as right", "[slow][figures]") {
  const Scene scene = shipped("brick_wall", {{"/time/end", "0.4"}});  // at rest well before its end at 1 s
  const std::uint32_t left = body_number(scene, "c20b1"), right = body_number(scene, "c20b21");
  Motion l{}, r{};
  const Course course = run(scene, "c20b11", {}, [&](const Simulation& s) {
    l = s.body_motion(left);
    r = s.body_motion(right);
  });
  const Motion& top = course.motion.back();
  INFO(fmt::format("{:.6e} m, speed {:.1e} m/s, left {:.6e}, right {:.6e}", -top.displacement.y,
                   std::hypot(top.velocity.x, top.velocity.y), l.displacement.x, r.displacement.x));
  CHECK(-top.displacement.y > 0.000333);
  CHECK(-top.displacement.y < 0.000353);
  CHECK(std::hypot(top.velocity.x, top.velocity.y) < 1e-4);
  CHECK(l.displacement.x == Approx(-r.displacement.x).margin(1e-9));
  CHECK(l.displacement.y == Approx(r.displacement.y).margin(1e-9));
}

TEST_CASE("Series compression: a stiffness ratio of 1e6 settles by the soft part", "[figures]") {
  // Soft block under a stiff one: its own weight and that above, over its free-to-widen modulus, and two
  // joints.
  const std::string text = R"({
    "talus": 1, "gravity": [0, -10],
    "materials": {
      "soft": {"density": 2300, "model": "linear_elastic", "young_modulus": 1e8, "poisson_ratio": 0},
      "stiff": {"density": 2300, "model": "linear_elastic", "young_modulus": 1e14, "poisson_ratio": 0}
    },
    "contact": {"model": "overlap_area"},
    "interfaces": [{"between": ["*", "*"], "normal_stiffness": 1e10, "tangential_stiffness": 1e10,
                    "friction_angle": 30, "normal_damping": 0.3, "tangential_damping": 0.3}],
    "bodies": [
      {"name": "base", "polygon": [[-1, -1], [2, -1], [2, 0], [-1, 0]], "material": "soft", "fixed": true},
      {"name": "low", "polygon": [[0, 0], [1, 0], [1, 1], [0, 1]], "material": "soft"},
      {"name": "top", "polygon": [[0, 1], [1, 1], [1, 2], [0, 2]], "material": "stiff"}
    ],
    "damping": 150,
    "time": {"end": 0.25}
  })";
  const Course course = run(from_text(text), "top");
  const double weight = 2300 * 10;
  const double expected = 2 * weight / 1e10 + weight / 1e10 + 1.5 * weight / 1e8;
  INFO(fmt::format("{:.6e} of {:.6e} m", -course.motion.back().displacement.y, expected));
  CHECK(-course.motion.back().displacement.y == Approx(expected).epsilon(0.005));
}

TEST_CASE("Two contacts of one pair keep their friction apart, however near they face each other",
          "[figures][friction]") {
  // A wedge is pressed into a notch of 45°, whose two faces are longer than they are apart, as one body and
  // as two halves. Each face of 2.7 √2 m bears N (cos 45° + tan 30° sin 45°) of 1e6 N/m in all.
  const auto sunk = [](const std::string& wedge) {
    WorkingScene text;
    text.interface = R"("normal_stiffness": 1e9, "tangential_stiffness": 1e9, "friction_angle": 30,
                        "normal_damping": 0.3, "tangential_damping": 0.3)";
    text.bodies = R"({"name": "n", "material": "rock", "fixed": true, "polygon": [[-9, -1], [9, -1], [9, 4],
        [4, 4], [0, 0], [-4, 4], [-9, 4]]},)" +
                  wedge;
    text.time = R"({"end": 0.5, "safety": 0.05})";
    text.rest = R"("damping": 50, "loads": [)";
    const bool halves = wedge.find("\"r\"") != std::string::npos;
    for (const std::string& name :
         halves ? std::vector<std::string>{"l", "r"} : std::vector<std::string>{"w"})
      text.rest += fmt::format(
          R"({}{{"body": "{}", "point": [{}, 2], "force": [0, {{"scale": {}, "time": [[0, 0], [0.4, 1]]}}]}})",
          name == "r" ? ", " : "", name, name == "l" ? -0.5 : 0.5, halves ? -5e5 : -1e6);
    text.rest += "],";
    return run_to_end(text).body_motion(1).displacement.y;
  };
  const double whole = sunk(R"({"name": "w", "material": "rock", "fix": ["rotation", "x"],
      "polygon": [[-0.3, 0.3], [0.3, 0.3], [3, 3], [-3, 3]]})");
  const double halves = sunk(R"({"name": "l", "material": "rock", "fix": ["rotation", "x"],
      "polygon": [[-0.3, 0.3], [-0.001, 0.3], [-0.001, 3], [-3, 3]]},
      {"name": "r", "material": "rock", "fix": ["rotation", "x"],
      "polygon": [[0.001, 0.3], [0.3, 0.3], [3, 3], [0.001, 3]]})");
  CHECK(whole == Approx(halves).epsilon(1e-3));
  CHECK(whole ==
        Approx(-1e6 / (2.7 * std::sqrt(2.0) * 1e9 * (1 + std::tan(std::numbers::pi / 6)))).epsilon(1e-3));
}

TEST_CASE(
    "A contact that is bent around the foot of a valley keeps its friction where it parts and joins again",
    "[figures][friction]") {
  // A wedge, blunter by a hair than the valley it sits in, is pushed aside with 3 kN/m while its load changes
  // between 10 and 40 kN/m, with which it has two contacts and one.
  const double rise = 2 * std::tan(10 * std::numbers::pi / 180);
  WorkingScene text;
  text.cover = "block";
  text.interface = R"("normal_stiffness": 1e9, "tangential_stiffness": 1e9, "friction_angle": 30,
                      "normal_damping": 0.3, "tangential_damping": 0.3)";
  text.material =
      R"("density": 2000, "model": "linear_elastic", "young_modulus": 1e11, "poisson_ratio": 0.25)";
  text.bodies = fmt::format(R"({{"name": "floor", "material": "rock", "fixed": true,
      "polygon": [[-2, -1], [2, -1], [2, {0}], [0, 0], [-2, {0}]]}}, {{"name": "w", "material": "rock",
      "polygon": [[-1, {1}], [0, 1e-5], [1, {1}], [1, {2}], [-1, {2}]]}})",
                            rise, rise / 2, rise / 2 + 1);
  text.rest = R"("damping": 200, "loads": [{"body": "w", "point": [0, 0.476], "force": [
      {"scale": 3000, "time": [[0.1, 0], [0.2, 1]]},
      {"scale": -1e4, "time": [[0, 0], [0.1, 4], [0.3, 4], [0.35, 1], [0.4, 1], [0.45, 4], [0.5, 4], [0.55, 1],
        [0.6, 1], [0.65, 4], [0.7, 4], [0.75, 1], [0.8, 1], [0.85, 4]]}]}],)";
  text.time = R"({"end": 1})";
  text.output = R"({"history": 0.05})";
  const Course course = run(text.read(), "w");
  CHECK(course.displacement(0.25).x > 1e-6);
  CHECK(course.displacement(1).x - course.displacement(0.25).x < 1e-6);
}
