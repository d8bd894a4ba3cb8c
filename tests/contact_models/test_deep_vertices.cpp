// Vertices of `vertex_edge` that sink into another body: what pushes them back grows without a jump.
#include "output/sampled.hpp"
#include "simulation/working_scene.hpp"

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace talus;

namespace {

/// The largest change of the upward force between two outputs over the largest force, while the second of two
/// bodies sinks at 1 m/s; and that force at the end, N/m.
std::pair<double, double> jump_of(const char* below, const char* above, double way) {
  WorkingScene text;
  text.law = "vertex_edge";
  text.interface = R"("normal_stiffness": 1e9, "tangential_stiffness": 0, "friction_angle": 0,
                      "normal_damping": 0, "tangential_damping": 0)";
  text.bodies = fmt::format(
      R"({{"name": "below", "material": "rock", "fixed": true, "polygon": [{}]}},
         {{"name": "above", "material": "rock", "polygon": [{}], "drive": {{"x": 0, "y": -1, "rotation": 0}}}})",
      below, above);
  text.rest = R"("limits": {"penetration": 1, "energy_residual": 1e9},)";
  text.time = fmt::format(R"({{"end": {}, "dt": 5e-4}})", way);
  text.output = R"({"history": 5e-4})";
  Simulation simulation(text.read(), {});
  double last = 0, jump = 0, largest = 0;
  while (simulation.advance()) {
    const double force = contact_sum(simulation.contacts(), 1, {}).force.y;
    jump = std::max(jump, std::abs(force - last));
    largest = std::max(largest, force);
    last = force;
  }
  return {jump / largest, last};
}

}  // namespace

TEST_CASE("a vertex that comes to stand on a third face of a bowl stays on the others",
          "[laws][vertex_edge]") {
  const auto [jump, force] = jump_of(
      "[-2, -1.5], [2, -1.5], [2, 1], [1, 1], [0.73, 0.92], [0.077, 0.81], [-0.065, 0.8], [-0.37, 0.868], "
      "[-1, 1], [-2, 1]",
      "[-0.172, 0.832], [0.035, 1.832], [-0.172, 2.432], [-0.397, 1.832]", 0.1);
  CHECK(force > 1e6);
  CHECK(jump < 0.05);
}

TEST_CASE("a tip that leaves a reflex corner for one of its faces feels no jump", "[laws][vertex_edge]") {
  const auto [jump, force] = jump_of(
      "[-2, -1.5], [2, -1.5], [2, 1.05], [1, 1.05], [0.825, 0.819], [0.462, 0.497], [0.208, 0.413], "
      "[-0.24, 0.421], [-0.554, 0.586], [-0.807, 0.776], [-1, 1.05], [-2, 1.05]",
      "[0.5233, 0.5519], [1.1104, 2.4638], [0.5456, 2.5518]", 0.3);
  CHECK(force > 1e6);
  CHECK(jump < 0.1);
}

TEST_CASE("a vertex sinks further than to the cut that ends on its edge", "[laws][vertex_edge]") {
  const auto [jump, force] =
      jump_of("[-3, -2], [3, -2], [3, 0.3], [-3, 0.3]",
              "[-0.5, 1.2], [0, 0.4], [0.5, 1.2], [0.9, 2.2], [0.1, 1.5], [-0.8, 2]", 0.6);
  CHECK(force > 1e7);
  CHECK(jump < 0.05);
}

TEST_CASE("what a cut vertex bears is the same bits however candidates are sought", "[laws][vertex_edge]") {
  // Of the edge that a cut ends on the part beyond comes near long after the vertex.
  WorkingScene text;
  text.law = "vertex_edge";
  text.gravity = "[0, -9.81]";
  text.interface = R"("normal_stiffness": 1e6, "tangential_stiffness": 1e6, "friction_angle": 20,
                      "normal_damping": 0, "tangential_damping": 0)";
  text.bodies = box("floor", -3, -2, 3, 0.3, R"("fixed": true)") +
                R"(, {"name": "a", "material": "rock", "velocity": [0.1, -3], "polygon":
                [[-0.5, 1.2], [0, 0.4], [0.5, 1.2], [0.9, 2.2], [0.1, 1.5], [-0.8, 2]]})";
  text.rest = R"("limits": {"penetration": 1, "energy_residual": 1e9},)";
  text.time = R"({"end": 0.5, "dt": 5e-4})";
  const auto hash = [&](bool skin) {
    Simulation simulation(text.read(), {.neighbour_skin = skin});
    while (simulation.advance()) {
    }
    return simulation.state_hash();
  };
  CHECK(hash(true) == hash(false));
}

TEST_CASE("a vertex bears as in the mirror, whatever else its neighbour only seems to stand on",
          "[laws][vertex_edge]") {
  const std::vector<Vec2> fixed{{0.584532, 0.415492}, {0.460097, 0.064589}, {1.083784, 0.165555},
                                {1.275028, 0.779491}, {1.236706, 1.399793}, {0.513694, 1.347261},
                                {0.252577, 0.706070}},
      star{{2.486526, 1.627953}, {2.001207, 1.886969}, {2.075253, 2.432075}, {1.678943, 2.050550},
           {1.183397, 2.289419}, {1.423782, 1.794607}, {1.043472, 1.397130}, {1.588349, 1.472845},
           {1.848850, 0.988321}, {1.945218, 1.529927}};
  const auto force = [&](bool mirrored) {
    const auto polygon = [&](std::vector<Vec2> points) {
      if (mirrored) std::ranges::reverse(points);
      std::string text;
      for (const Vec2& p : points)
        text += fmt::format("{}[{}, {}]", text.empty() ? "" : ", ", mirrored ? -p.x : p.x, p.y);
      return text;
    };
    WorkingScene text;
    text.law = "vertex_edge";
    text.interface = R"("normal_stiffness": 1e8, "tangential_stiffness": 0, "friction_angle": 0,
                        "normal_damping": 0, "tangential_damping": 0)";
    text.bodies = fmt::format(
        R"({{"name": "a", "material": "rock", "fixed": true, "polygon": [{}]}}, {{"name": "star", "material": "rock",
            "polygon": [{}], "drive": {{"x": {}, "y": -5.335, "rotation": 0}}}})",
        polygon(fixed), polygon(star), mirrored ? -3.941 : 3.941);
    text.rest = R"("limits": {"penetration": 1, "energy_residual": 1e9},)";
    text.time = R"({"end": 0.004, "dt": 1e-5})";
    const Vec2 sum = contact_sum(run_to_end(text).contacts(), 1, {}).force;
    return std::hypot(sum.x, sum.y);
  };
  CHECK(force(false) > 1e4);
  CHECK(force(true) == Approx(force(false)).epsilon(1e-9));
}

TEST_CASE("a tip in which a cut ends pushes as one without, and nothing that passes it",
          "[laws][vertex_edge]") {
  const auto force = [&](const char* below, double aside) {
    const std::string above =
        fmt::format("[{}, 2e-4], [{}, 0.7], [{}, 0.7]", aside, aside + 0.5, aside - 0.5);
    return jump_of(below, above.c_str(), 0.0042);
  };
  const char *whole = "[0, 0], [-0.5, -0.6], [0.5, -0.6]",
             *arrow = "[0, 0], [-0.5, -0.6], [0, -0.35], [0.5, -0.6]";
  CHECK(force(whole, 0.003).second > 100);
  CHECK(force(arrow, 0.003).second == Approx(force(whole, 0.003).second).epsilon(1e-6));
  CHECK(force(arrow, 0.006).second == 0);
}
