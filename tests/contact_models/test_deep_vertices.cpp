// Vertices of `vertex_edge` that sink into another body: what pushes them back grows without a jump.
#include "output/quantity.hpp"
#include "simulation/working_scene.hpp"

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
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

TEST_CASE("the further face of a reflex corner comes in near the corner, without a jump",
          "[laws][vertex_edge]") {
  // A tip is driven along the one face into the other, ever deeper; the cut of the notch may lean over
  // either.
  for (const double turn : {0.3, 10.0, 60.0}) {
    for (const double lean : {-2.0, 2.0}) {
      INFO("turned by " << turn << " degrees, leaning " << lean);
      const double slope = std::tan(turn / 2 * std::numbers::pi / 180), across = 1 / std::hypot(1, slope);
      const Vec2 start{-0.5, 0.5 * slope}, speed{1, -slope - 0.01};
      WorkingScene text;
      text.law =
          R"(vertex_edge", "vertex_edge": {"calibration": "springs", "normal_spring": 1e8}, "roles": "symmetric)";
      text.interface = R"("normal_stiffness": 0, "tangential_stiffness": 0, "friction_angle": 0,
                          "normal_damping": 0, "tangential_damping": 0)";
      text.bodies = fmt::format(
          R"({{"name": "notch", "material": "rock", "fixed": true,
               "polygon": [[{}, -3], [4, -2], [4, {}], [0, 0], [-4, {}], [-4, -2]]}},
             {{"name": "tip", "material": "rock", "polygon": [[{}, {}], [-0.2, 8], [-0.8, 8]],
               "drive": {{"x": {}, "y": {}, "rotation": 0}}}})",
          lean, 4 * slope, 4 * slope, start.x, start.y, speed.x, speed.y);
      text.rest = R"("limits": {"penetration": 1, "energy_residual": 1e9},)";
      text.time = R"({"end": 0.55, "dt": 1e-4})";
      text.output = R"({"history": 1e-4})";
      const auto run = [&](bool skin) {
        Simulation simulation(text.read(), {.neighbour_skin = skin});
        double last = 0, jump = 0, largest = 0;
        do {
          const Vec2 moved = simulation.body_motion(1).displacement;
          const Vec2 at{start.x + moved.x, start.y + moved.y};
          const double left = std::max(0.0, (-slope * at.x - at.y) * across),
                       right = std::max(0.0, (slope * at.x - at.y) * across);
          const Vec2 force = contact_sum(simulation.contacts(), 1, {}).force;
          const double size = std::hypot(force.x, force.y);
          const double near = at.x < 0 ? left : right;
          if (std::abs(at.x) > 3.5 * near) CHECK(size == Approx(1e8 * near).epsilon(1e-6).margin(1));
          if (std::abs(at.x) < near) {
            CHECK(force.x == Approx(1e8 * slope * across * (left - right)).epsilon(1e-6).margin(1));
            CHECK(force.y == Approx(1e8 * across * (left + right)).epsilon(1e-6).margin(1));
          }
          jump = std::max(jump, std::abs(size - last));
          largest = std::max(largest, size);
          last = size;
        } while (simulation.advance());
        CHECK(jump < 0.02 * largest);
        return simulation.state_hash();
      };
      CHECK(run(true) == run(false));
    }
  }
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
