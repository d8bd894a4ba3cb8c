#include "conformance/pairs.hpp"
#include "contact_models/block_on_base.hpp"
#include "simulation/working_scene.hpp"

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace talus;
using namespace talus::bench;

TEST_CASE("Springs per area: the corners of a side carry alpha L together", "[vertex_edge]") {
  LawBench bench("vertex_edge");
  bench.bodies = block_on_base(1e-3);
  const Evaluation e = bench.look();
  CHECK(e.contacts.size() == 2);
  CHECK(e.on(1).y == Approx(1e6).epsilon(1e-9));
}

TEST_CASE("Springs given directly count per vertex, whatever its edges", "[vertex_edge]") {
  LawBench bench("vertex_edge", undamped_interface(),
                 {{"calibration", 1}, {"normal_spring", 3e8}, {"tangential_spring", 2e8}});
  bench.bodies = block_on_base(1e-3);
  CHECK(bench.step().on(1).y == Approx(2 * 3e8 * 1e-3).epsilon(1e-9));
  CHECK(shifted(bench, {1e-4, 0}).on(1).x == Approx(-2 * 2e8 * 1e-4).epsilon(1e-9));
}

TEST_CASE("Points along a base, and corners cut off, bear no less than a base without", "[vertex_edge]") {
  const auto load_on = [](std::vector<Vec2> block, double depth) {
    for (Vec2& corner : block) corner.y -= depth;
    LawBench bench("vertex_edge");
    bench.bodies = {box(-2, -1, 4, 0), conformance::held(block)};
    return bench.look().on(1).y;
  };
  const double depth = 1e-3, due = 1e9 * 3 * depth;
  for (const double at : {1e-8, 1e-5, 1e-3, 0.01, 0.1}) {
    INFO(at << " m");
    CHECK(load_on({{0, 0}, {at, 0}, {3, 0}, {3, 1.5}, {0, 1.5}}, depth) == Approx(due).epsilon(1e-9));
    if (at > depth) continue;
    // The corner above the one on the base bears the least that any does.
    CHECK(load_on({{0, at}, {at, 0}, {3, 0}, {3, 1.5}, {0, 1.5}}, depth) == Approx(due).epsilon(0.03));
    CHECK(load_on({{0, 0}, {3, 0}, {3, 1.5}, {0, 1.5}, {0, at}}, depth) == Approx(due).epsilon(1e-9));
  }
}

TEST_CASE("A toe passes the corner that it stands at without a jump", "[vertex_edge]") {
  // Its corner stands past the end of a face until it is further from the next one than it is deep.
  LawBench bench("vertex_edge");
  bench.bodies = {conformance::held({{-2, -1}, {1, -1}, {0, 0}, {-2, 0}}), box(-1, -1e-4, 2e-9, 1 - 1e-4)};
  for (int i = 0; i < 40; ++i) {
    const double load = shifted(bench, {5e-6, 0}).on(1).y;
    CHECK(load == Approx(1e9 * 1e-4).epsilon(1e-3));
  }
}

TEST_CASE("Corner to corner: each stands on the other's edge and counts half", "[vertex_edge]") {
  LawBench bench("vertex_edge", undamped_interface());
  bench.bodies = {box(-1, -1, 0, 0), box(-2e-3, -1e-3, 0.998, 0.999)};
  const Evaluation e = bench.look();
  REQUIRE(e.contacts.size() == 2);
  // Both vertices are least deep behind a level side: the force is upright.
  CHECK(e.on(1).y > 0);
  CHECK(std::abs(e.on(1).x) <= 1e-9 * e.on(1).y);
  CHECK(e.contacts[0].py == Approx(e.contacts[1].py).epsilon(1e-9));
}

TEST_CASE("A corner of one block against the side of another passes its end without a jump",
          "[vertex_edge]") {
  // The upper block slides off the end of the lower: force goes down as its corner nears the edge and stays
  // finite.
  LawBench bench("vertex_edge", undamped_interface());
  bench.bodies = {box(-1, -1, 0, 0), box(-0.2, -1e-3, 0.8, 1)};
  double before = bench.step().on(1).y;
  for (int i = 0; i < 150; ++i) {
    const Evaluation e = shifted(bench, {1e-3, 0});
    CHECK(std::abs(e.on(1).y - before) <= 0.02 * 1e6);
    before = e.on(1).y;
  }
}

TEST_CASE("A vertex passes the joint between collinear edges without a kick", "[vertex_edge]") {
  LawBench whole("vertex_edge"), divided("vertex_edge");
  whole.bodies = block_on_base(1e-3);
  divided.bodies = block_on_base(1e-3);
  divided.bodies[0] = held({{-2, -1}, {2, -1}, {2, 0}, {0.55, 0}, {0.51, 0}, {-0.48, 0}, {-2, 0}});
  // The centres differ by round-off; what counts are the forces.
  for (int i = 0; i < 100; ++i) {
    const Vec2 p = shifted(whole, {1e-3, 0}).on(1), q = shifted(divided, {1e-3, 0}).on(1);
    CHECK(p.x == Approx(q.x).epsilon(1e-9));
    CHECK(p.y == Approx(q.y).epsilon(1e-9));
  }
}

TEST_CASE("A body of many elements that leans by a hair stands on its base alone", "[vertex_edge]") {
  // A pressure that rises from 0.4 to 1.6 of its mean is borne by a base pressure that does so, too; the
  // upright sides at the ends of the base carry nothing.
  WorkingScene text;
  text.law = "vertex_edge";
  text.material =
      R"("density": 2000, "model": "linear_elastic", "young_modulus": 1e11, "poisson_ratio": 0,
                     "damping_time": 1e-6)";
  text.interface = R"("normal_stiffness": 1e8, "tangential_stiffness": 1e8, "friction_angle": 0,
                      "normal_damping": 0.3, "tangential_damping": 0)";
  text.bodies =
      box("base", -2, -3, 3, 0, R"("fixed": true)") + "," +
      box("a", 0, 0, 1, 1,
          R"("surfaces": {"top": [2]}, "cover": {"model": "hexagonal", "size": 0.25, "angle": 11})");
  text.rest = R"("damping": 100, "surface_loads": [{"body": "a", "surface": "top",
      "pressure": {"scale": 1e5, "x": [[0, 0.4], [1, 1.6]]}}], "limits": {"energy_residual": 1e9},)";
  text.time = R"({"end": 0.2})";
  const Simulation simulation = run_to_end(text);
  CHECK(simulation.point_motion(1, {0, 0}).displacement.y == Approx(-0.4e-3).epsilon(0.06));
  CHECK(simulation.point_motion(1, {1, 0}).displacement.y == Approx(-1.6e-3).epsilon(0.03));
}

TEST_CASE("A block on a body of many elements meets alpha L, wherever its corners stand between their sides",
          "[vertex_edge]") {
  const double wide = GENERATE(0.3, 1.0);
  const double left = GENERATE(0.07, 0.21);
  const std::string size = GENERATE("0.25", "1");
  INFO(wide << " m from " << left << " m on elements of " << size << " m");
  WorkingScene text;
  text.law = "vertex_edge";
  text.cover = "block";
  text.gravity = "[0, -10]";
  text.material = R"("density": 2000, "model": "linear_elastic", "young_modulus": 2e10, "poisson_ratio": 0)";
  text.interface = R"("normal_stiffness": 1e8, "tangential_stiffness": 1e8, "friction_angle": 30,
                      "normal_damping": 0.5, "tangential_damping": 0.5)";
  text.bodies = box("floor", -4, -3, 5, -1, R"("fixed": true)") + "," +
                box("ground", -2, -1, 3, 0,
                    R"("cover": {"model": "hexagonal", "size": )" + size + R"(, "angle": 11})") +
                "," + box("block", left, 0, left + wide, 1);
  text.rest = R"("damping": 30,)";
  text.time = R"({"end": 0.2})";
  const Simulation simulation = run_to_end(text);
  const Vec2 below{left + wide / 2, 0};
  const double sunk =
      simulation.point_motion(1, below).displacement.y - simulation.point_motion(2, below).displacement.y;
  // The least that a corner bears comes on top, and a narrow block leans where its ends differ.
  CHECK(sunk == Approx(2000 * 10 / 1e8).epsilon(wide < 1 ? 0.05 : 0.01));
}

TEST_CASE("The force of a corner beside a node of a flat side does not flutter", "[vertex_edge]") {
  // The apex stands 5 mm from a node of the lattice, so near that both sides there would bear it.
  WorkingScene text;
  text.law = "vertex_edge";
  text.material = R"("density": 1000, "model": "linear_elastic", "young_modulus": 9e6, "poisson_ratio": 0.3)";
  text.interface = R"("normal_stiffness": 5e6, "tangential_stiffness": 2e6, "friction_angle": 0,
                      "normal_damping": 0, "tangential_damping": 0)";
  text.bodies =
      R"({"name": "apex", "material": "rock", "polygon": [[0.406, -0.56], [0.898, -0.56], [0.418, 0]],
                    "fix": ["x", "y", "rotation"]}, )" +
      box("slab", -0.473, 0.0005, 0.5893, 1.2096,
          R"("cover": {"model": "hexagonal", "size": 0.3, "angle": 13}, "velocity": [0, -1])");
  text.time = R"({"end": 0.01, "dt": 2e-5})";
  text.output = R"({"history": 2e-5})";
  Simulation simulation(text.read(), {});
  double before = 0, largest = 0, largest_change = 0;
  while (simulation.advance()) {
    double force = 0;
    for (const Contact& contact : simulation.contacts()) force += contact.normal_force.y;
    largest_change = std::max(largest_change, std::abs(force - before));
    largest = std::max(largest, std::abs(force));
    before = force;
  }
  CHECK(largest > 100);
  CHECK(largest_change < 0.1 * largest);
  CHECK(residual_share(simulation.ledger()) < 1e-3);
}

TEST_CASE("Concave bodies stand on the corners where cuts end", "[vertex_edge]") {
  // Of equal walls the bisectors of inner corners end in outer ones.
  struct Shape {
    const char *polygon, *holes;
    double area;
  };
  const Shape shape = GENERATE(
      Shape{"[[0, 0], [2, 0], [2, 0.5], [0.5, 0.5], [0.5, 2], [0, 2]]", "[]", 1.75},
      Shape{"[[0, 0], [2, 0], [2, 2], [1.5, 2], [1.5, 0.5], [0.5, 0.5], [0.5, 2], [0, 2]]", "[]", 2.5},
      Shape{"[[0, 0], [4, 0], [4, 3], [0, 3]]", "[[[0.5, 0.5], [3.5, 0.5], [3.5, 2.5], [0.5, 2.5]]]", 6});
  const char* const cover = GENERATE("rigid", "block");
  const bool upside_down = GENERATE(false, true);
  INFO(shape.polygon << " " << cover << (upside_down ? ", upside down" : ""));
  WorkingScene text;
  text.law = "vertex_edge";
  text.cover = cover;
  text.gravity = upside_down ? "[0, 10]" : "[0, -10]";
  text.material = R"("density": 2000, "model": "linear_elastic", "young_modulus": 2e10, "poisson_ratio": 0)";
  text.interface = R"("normal_stiffness": 1e9, "tangential_stiffness": 1e9, "friction_angle": 30,
                      "normal_damping": 0.5, "tangential_damping": 0.5)";
  const double top = shape.area > 5 ? 3 : 2;
  text.bodies = (upside_down ? box("floor", -3, top, 7, top + 1, R"("fixed": true)")
                             : box("floor", -3, -1, 7, 0, R"("fixed": true)")) +
                fmt::format(R"(, {{"name": "a", "polygon": {}, "holes": {}, "material": "rock"}})",
                            shape.polygon, shape.holes);
  text.rest = R"("damping": 20,)";
  text.time = R"({"end": 0.3})";
  const Simulation simulation = run_to_end(text);
  // Upside down an L falls over, off its only leg.
  if (upside_down && shape.area < 2) return;
  const double sunk = simulation.body_motion(1).displacement.y * (upside_down ? 1 : -1);
  CHECK(sunk > 0);
  CHECK(sunk < 2e-4);
}

TEST_CASE("A block slides over the joint between two bodies of many elements", "[vertex_edge]") {
  const char* const offset = GENERATE("0.03", "0.07", "0.11");
  INFO(offset);
  WorkingScene text;
  text.law = "vertex_edge";
  text.gravity = "[0, -9.81]";
  text.material =
      R"("density": 2000, "model": "linear_elastic", "young_modulus": 2e8, "poisson_ratio": 0.25, "damping_time": 1e-3)";
  text.interface = R"("normal_stiffness": 1e8, "tangential_stiffness": 1e8, "friction_angle": 10,
                      "normal_damping": 0, "tangential_damping": 0)";
  const std::string lattice = R"("fix": ["x", "y", "rotation"], "cover": {"model": "hexagonal", "size": 0.22,
                                 "angle": 3, "offset_x": )" +
                              std::string(offset) + "}";
  text.bodies = box("left", 0, 0, 1.7, 0.5, lattice) + "," + box("right", 1.7, 0, 4, 0.5, lattice) + "," +
                box("block", 0.3, 0.5, 1.3, 1, R"("velocity": [2, 0])");
  text.rest = R"("settle": {"duration": 1, "damping": 100},)";
  text.time = R"({"end": 0.4})";
  const Simulation simulation = run_to_end(text);
  CHECK(simulation.body_motion(2).displacement.x > 0.6);
  CHECK(simulation.summary().largest_penetration < 2e-3);
  CHECK(simulation.summary().largest_residual_share < 0.01);
}

TEST_CASE("Jagged bodies of many elements meet alike in the mirror", "[vertex_edge]") {
  const auto speed_after = [](bool mirrored) {
    const auto polygon = [&](std::vector<Vec2> ring) {
      if (mirrored) std::reverse(ring.begin(), ring.end());
      std::string points;
      for (const Vec2 p : ring)
        points += fmt::format("{}[{}, {}]", points.empty() ? "" : ", ", mirrored ? -p.x : p.x, p.y);
      return points;
    };
    const double sign = mirrored ? -1 : 1;
    WorkingScene text;
    text.law = "vertex_edge";
    text.material =
        R"("density": 2000, "model": "linear_elastic", "young_modulus": 1e8, "poisson_ratio": 0.25)";
    text.interface = R"("normal_stiffness": 1e8, "tangential_stiffness": 1e8, "friction_angle": 0,
                        "normal_damping": 0, "tangential_damping": 0)";
    text.bodies = fmt::format(
        R"({{"name": "a", "material": "rock", "polygon": [{}],
             "cover": {{"model": "hexagonal", "size": 0.3, "offset_x": {}, "angle": {}}}}},
           {{"name": "b", "material": "rock", "polygon": [{}], "velocity": [{}, -3],
             "cover": {{"model": "hexagonal", "size": 0.25, "offset_y": 0.02, "angle": {}}}}})",
        polygon({{0, 0}, {2, 0}, {2, 1}, {1.4, 1}, {1.2, 0.7}, {0.8, 0.7}, {0.6, 1}, {0, 1}}), 0.03 * sign,
        11 * sign,
        polygon({{0.3, 1.12}, {0.6, 1.05}, {0.9, 1.15}, {1.2, 1.03}, {1.5, 1.12}, {1.5, 1.9}, {0.3, 1.9}}),
        sign, 31 * sign);
    text.rest = R"("limits": {"energy_residual": 1},)";
    text.time = R"({"end": 0.05, "dt": 4e-5})";
    const Vec2 velocity = run_to_end(text).body_motion(1).velocity;
    return Vec2{sign * velocity.x, velocity.y};
  };
  const Vec2 drawn = speed_after(false), mirrored = speed_after(true);
  CHECK(drawn.y > -3);  // they have met
  CHECK(mirrored.x == Approx(drawn.x).epsilon(1e-6));
  CHECK(mirrored.y == Approx(drawn.y).epsilon(1e-6));
}

TEST_CASE("Friction slips as the side moves where it acts, at the vertex behind it", "[vertex_edge]") {
  // A beam held at its middle is turned onto a fixed corner: at the foot on its side nothing else slips.
  WorkingScene text;
  text.law =
      R"(vertex_edge", "vertex_edge": {"calibration": "springs", "normal_spring": 1e7, "tangential_spring": 1e7}, "roles": "symmetric)";
  text.interface = R"("normal_stiffness": 1e8, "tangential_stiffness": 1e8, "friction_angle": 30,
                      "normal_damping": 0, "tangential_damping": 0)";
  text.bodies = box("beam", -1, -0.1, 1, 0.1, R"("fix": ["x", "y"], "drive": {"rotation": -3})") +
                R"(, {"name": "corner", "material": "rock", "fixed": true,
                      "polygon": [[0.3, -0.1], [0.1, -0.6], [0.5, -0.6]]})";
  text.time = R"({"end": 1, "dt": 1e-3})";
  text.rest = R"("limits": {"energy_residual": 1},)";
  const Simulation simulation = run_to_end(text);
  CHECK(simulation.ledger().contact > 10);
  CHECK(residual_share(simulation.ledger()) < 1e-4);
}

namespace {

/// A block of 1 x 0.5 m, 10 kN/m, whose ends hang from a ceiling or stand on a floor by their bonds.
WorkingScene bonded_block(const std::string& interface, double stiffness = 1e8) {
  WorkingScene text;
  text.law = "vertex_edge";
  text.gravity = "[0, -10]";
  text.material = R"("density": 2000)";
  text.interface =
      fmt::format(R"("normal_stiffness": {0}, "tangential_stiffness": {0}, )", stiffness) + interface;
  text.rest = R"("limits": {"energy_residual": 1},)";
  return text;
}

}  // namespace
