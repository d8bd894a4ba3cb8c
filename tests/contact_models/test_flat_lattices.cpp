#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <cmath>
#include <string>

using namespace talus;

namespace {

constexpr const char* springs = R"("normal_stiffness": {}, "tangential_stiffness": {}, "friction_angle": 0,
                                   "normal_damping": {}, "tangential_damping": 0)";

constexpr const char* hard_rock =
    R"("density": 2000, "model": "linear_elastic", "young_modulus": 1e10, "poisson_ratio": 0.25)";

std::string lattice(double size, const std::string& more = "", double offset_y = 0) {
  return fmt::format(R"("cover": {{"model": "hexagonal", "size": {}, "offset_y": {}}}{})", size, offset_y,
                     more);
}

}  // namespace

TEST_CASE("Equal bodies of many elements pressed together, flush, keep their energy", "[vertex_edge]") {
  const double size = GENERATE(0.1, 0.15);
  CAPTURE(size);
  WorkingScene text;
  text.law = "vertex_edge";
  text.material = R"("density": 2000, "model": "linear_elastic", "young_modulus": 8e9, "poisson_ratio": 0.2)";
  text.interface = fmt::format(springs, "2e8", "2e8", "0");
  text.bodies = box("a", -1, 0, 0, 0.3, lattice(size, R"(, "surfaces": {"left": [3]})")) + "," +
                box("b", 0, 0, 1, 0.3, lattice(size, R"(, "surfaces": {"right": [1]})"));
  text.rest = R"("damping": 60, "surface_loads": [{"body": "a", "surface": "left", "pressure": 1e5},
                                                  {"body": "b", "surface": "right", "pressure": 1e5}],)";
  text.time = R"({"end": 0.05})";
  const Simulation simulation = run_to_end(text);
  CHECK(simulation.summary().largest_penetration > 2e-4);
  CHECK(simulation.summary().largest_residual_share < 1e-4);
}

TEST_CASE("A block of many elements stands on another with the stiffness of its base", "[vertex_edge]") {
  // Ends of the base at nodes of the lattice below, between two of them, and within one of its sides.
  struct Base {
    double left, width, upper, lower, offset_y = 0;
  };
  const Base base =
      GENERATE(Base{0.25, 0.5, 0.25, 0.25}, Base{0.08, 0.3, 0.1, 0.2}, Base{0.08, 0.3, 0.2, 0.1},
               Base{0.3, 0.12, 0.1, 0.5}, Base{0.35, 0.3, 0.1, 0.5, 0.2}, Base{0.28, 0.3, 0.1, 0.5, 0.2});
  CAPTURE(base.left, base.width, base.upper, base.lower);
  WorkingScene text;
  text.law = "vertex_edge";
  text.gravity = "[0, -10]";
  text.material = R"("density": 2000, "model": "linear_elastic", "young_modulus": 1e12, "poisson_ratio": 0)";
  text.interface = fmt::format(springs, "1e8", "1e8", "0.5");
  text.bodies =
      box("lower", 0, 0, 1, 0.5, lattice(base.lower, R"(, "fix": ["x", "y", "rotation"])", base.offset_y)) +
      "," + box("upper", base.left, 0.5, base.left + base.width, 0.9, lattice(base.upper));
  text.rest = R"("damping": 200,)";
  text.time = R"({"end": 0.3})";
  const Simulation simulation = run_to_end(text);
  const Motion &lower = simulation.body_motion(0), &upper = simulation.body_motion(1);
  CHECK(lower.displacement.y - upper.displacement.y == Approx(2000 * 10 * 0.4 / 1e8).epsilon(0.01));
  CHECK(std::abs(upper.rotation - lower.rotation) < 2e-6);
}

TEST_CASE("A corner a little past a node of the side below stands where its foot is", "[vertex_edge]") {
  // The side bends inwards under the load, so that the corner is less deep behind what lies before the node.
  const double past = GENERATE(1e-4, 5e-4, 9e-4);
  const std::string upper = GENERATE(lattice(0.25), std::string(R"("cover": {"model": "block"})"));
  CAPTURE(past, upper);
  WorkingScene text;
  text.law = "vertex_edge";
  text.gravity = "[0, -10]";
  text.material = hard_rock;
  text.interface = fmt::format(springs, "1e7", "1e7", "0");
  const double row_at_the_top = 0.25 - 0.25 * std::sqrt(0.75);  // with nodes at 0.375 m on both sides
  text.bodies =
      box("lower", -1, -0.5, 1, 0, lattice(0.25, R"(, "fix": ["x", "y", "rotation"])", row_at_the_top)) +
      "," + box("upper", past - 0.375, 0, past + 0.375, 0.5, upper + R"(, "fix": ["x", "rotation"])");
  text.rest = R"("settle": {"duration": 2, "damping": "adaptive", "until": 1e-7},)";
  text.time = R"({"end": 0.02})";
  const Simulation simulation = settle_and_run(text);
  CHECK(0.25 - simulation.body_motion(1).position.y == Approx(2000 * 10 * 0.5 / 1e7).epsilon(0.02));
  CHECK(simulation.summary().largest_residual_share < 1e-3);
}

TEST_CASE("A side shorter than the overlap, as a lattice cuts it off, spoils no support", "[vertex_edge]") {
  // The last side of the base is of 1.3 mm: what stands 7 mm deep above it is nearer to the flank.
  WorkingScene text;
  text.law = "vertex_edge";
  text.gravity = "[0, -10]";
  text.material = hard_rock;
  text.interface = fmt::format(springs, "1e7", "1e7", "0");
  text.bodies = box("base", -0.37, -1, 0.21, 0, lattice(0.25, R"(, "fix": ["x", "y", "rotation"])")) + "," +
                box("block", -0.5, 0, 0.5, 1, lattice(0.25, R"(, "fix": ["x"])"));
  text.rest = R"("settle": {"duration": 3, "damping": 60},)";
  text.time = R"({"end": 0.09})";
  const Simulation simulation = settle_and_run(text);
  CHECK(simulation.summary().largest_residual_share < 1e-3);
  CHECK(std::abs(simulation.body_motion(1).velocity.y) < 1e-6);
}

TEST_CASE("A block that rocks on a wider one keeps its energy as the ends of sides below lift off",
          "[vertex_edge]") {
  const auto turned = [](double size, double angle) {
    return fmt::format(R"("cover": {{"model": "hexagonal", "size": {}, "angle": {}}})", size, angle);
  };
  WorkingScene text;
  text.law = "vertex_edge";
  text.gravity = "[0, -9.81]";
  text.interface = fmt::format(springs, "5e7", "5e7", "0");
  text.bodies = box("floor", -2, -1, 3, 0, R"("fixed": true)") + "," +
                box("lower", 0, 0, 1, 1, turned(0.33854, 12.0028)) + "," +
                box("upper", 0.002, 1, 0.352, 2, turned(0.188304, 25.0873));
  text.rest = R"("limits": {"energy_residual": 1},)";
  text.time = R"({"end": 0.6})";
  CHECK(run_to_end(text).summary().largest_residual_share < 0.02);  // 0.058 where the side counted whole
}

TEST_CASE("Bodies of many elements part at the strength of their joint, wherever its ends lie",
          "[vertex_edge][bonds]") {
  const double shift = GENERATE(0.0, 5e-4, 0.03);
  const bool pulled = GENERATE(true, false);
  for (const double share : {0.97, 1.03}) {
    CAPTURE(shift, pulled, share);
    const double mean = 2000 * 10 * 0.5;
    WorkingScene text;
    text.law = "vertex_edge";
    text.gravity = pulled ? "[0, 10]" : "[10, 0]";
    text.material = hard_rock;
    text.interface =
        fmt::format(R"("normal_stiffness": 1e9, "tangential_stiffness": 1e9, "friction_angle": {},
        "normal_damping": 0.3, "tangential_damping": 0.3, "tensile_strength": {}, "cohesion": {})",
                    pulled ? 30 : 0, pulled ? share * mean : 1e6, pulled ? 1e6 : share * mean);
    text.bodies = box("lower", -1, -0.5, 1, 0, lattice(0.25, R"(, "fix": ["x", "y", "rotation"])")) + "," +
                  box("upper", shift - 0.25, 0, shift + 0.25, 0.5,
                      lattice(0.25, pulled ? R"(, "fix": ["x", "rotation"])" : R"(, "fix": ["rotation"])"));
    text.rest = R"("settle": {"duration": 1, "damping": 300, "until": 1e-5},)";
    text.time = R"({"end": 0.1})";
    const Simulation simulation = settle_and_run(text);
    const Vec2 velocity = simulation.body_motion(1).velocity;
    CHECK((std::abs(pulled ? velocity.y : velocity.x) > 0.5) == (share < 1));
  }
}

TEST_CASE("Stacks of bodies of many elements keep their energy, turned as well", "[vertex_edge]") {
  const double degrees = GENERATE(0.0, 20.0, 37.7), offset = GENERATE(0.0, 1e-4, 0.03);
  CAPTURE(degrees, offset);
  const double c = std::cos(degrees * 3.141592653589793 / 180),
               s = std::sin(degrees * 3.141592653589793 / 180);
  const auto turned = [&](const char* name, double left, double bottom, const std::string& more) {
    const auto at = [&](double x, double y) { return fmt::format("[{}, {}]", c * x - s * y, s * x + c * y); };
    return fmt::format(R"({{"name": "{}", "polygon": [{}, {}, {}, {}], "material": "rock", {}}})", name,
                       at(left, bottom), at(left + 1, bottom), at(left + 1, bottom + 1), at(left, bottom + 1),
                       more);
  };
  WorkingScene text;
  text.law = "vertex_edge";
  text.gravity = fmt::format("[{}, {}]", 10 * s, -10 * c);
  text.interface = fmt::format(springs, "5e7", "5e7", "0");
  text.bodies = turned("floor", 0, -1, R"("fixed": true)") + "," + turned("a", 0, 0, lattice(0.23)) + "," +
                turned("b", offset, 1, lattice(0.17));
  text.time = R"({"end": 0.2})";
  const Simulation simulation = run_to_end(text);
  CHECK(simulation.summary().largest_penetration > 1e-3);
  CHECK(simulation.summary().largest_residual_share < 5e-3);
}

TEST_CASE("A wall of flush bodies of many elements settles from where its bodies touch", "[vertex_edge]") {
  WorkingScene text;
  text.law = "vertex_edge";
  text.gravity = "[0, -10]";
  text.interface = R"("normal_stiffness": 1e9, "tangential_stiffness": 1e9, "friction_angle": 30,
                      "normal_damping": 0.3, "tangential_damping": 0.3)";
  text.bodies = box("floor", -2, -1, 4, 0, R"("fixed": true)");
  for (int column = 0; column < 2; ++column) {
    for (int row = 0; row < 3; ++row)
      text.bodies +=
          "," + box(fmt::format("b{}{}", column, row), column, row, column + 1, row + 1, lattice(0.1));
  }
  text.rest = R"("settle": {"duration": 0.004, "damping": 100},)";
  text.time = R"({"end": 0.002})";
  const Simulation simulation = settle_and_run(text);
  CHECK(simulation.summary().largest_residual_share < 1e-3);
}

TEST_CASE("A block of many elements rests on a slope of many elements", "[vertex_edge]") {
  // Patches of slivers follow their neighbours, so that sides lie straight but for rounding.
  WorkingScene text;
  text.law = "vertex_edge";
  text.gravity = "[0, -10]";
  text.material = R"("density": 2000, "model": "linear_elastic", "young_modulus": 1e9, "poisson_ratio": 0.2)";
  text.interface = R"("normal_stiffness": 1e8, "tangential_stiffness": 1e8, "friction_angle": 30,
                      "normal_damping": 0.3, "tangential_damping": 0.3)";
  text.bodies =
      R"({"name": "slope", "material": "rock", "fix": ["x", "y", "rotation"], "polygon": [[0, 0],
            [1.8793852415718169, 0.6840402866513374], [1.7083751699089824, 1.1538865970442918],
            [-0.17101007166283436, 0.4698463103929542]], "cover": {"model": "hexagonal", "size": 0.25, "angle": 20}},
         {"name": "block", "material": "rock", "polygon": [[0.12029464078079724, 0.5758725548239115],
            [0.6841102132523422, 0.7810846408193127], [0.5473021559220748, 1.1569616891336763],
            [-0.01651341654947025, 0.951749603138275]], "cover": {"model": "hexagonal", "size": 0.2, "angle": 20}})";
  text.rest = R"("settle": {"duration": 0.2, "damping": 100},)";
  text.time = R"({"end": 0.1})";
  const Simulation simulation = settle_and_run(text);
  CHECK(std::abs(simulation.body_motion(1).velocity.x) < 1e-5);
  CHECK(simulation.summary().largest_residual_share < 1e-3);
}

TEST_CASE("The mouth of a crack in a body of many elements bears on both its sides", "[vertex_edge]") {
  WorkingScene text;
  text.law = "vertex_edge";
  text.gravity = "[0, -10]";
  text.interface = fmt::format(springs, "1e8", "1e8", "0");
  text.bodies = box("below", 0, 0, 1, 0.4, lattice(0.2, R"(, "fix": ["x", "y", "rotation"])")) + "," +
                box("above", 0.05, 0.4, 0.48, 0.8,
                    lattice(0.38, R"(, "discontinuities": [{"points": [[0.25, 0.4], [0.25, 0.65]]}])"));
  text.time = R"({"end": 0.03})";
  const Simulation simulation = run_to_end(text);
  CHECK(simulation.summary().largest_penetration < 1e-3);
  CHECK(simulation.summary().largest_residual_share < 1e-4);
}
