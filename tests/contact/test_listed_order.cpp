#include "simulation/simulation.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

using namespace talus;

namespace {

const char* const as_lattice = R"({"model": "hexagonal", "size": 0.35})";
const char* const as_block = R"({"model": "block"})";

std::string tumbling(const char* name, const char* material, const char* polygon, const char* cover,
                     const char* velocity, double spin, int priority) {
  return fmt::format(R"({{"name": "{}", "material": "{}", "polygon": {}, "cover": {}, "velocity": {},
                         "angular_velocity": {}, "priority": {}}})",
                     name, material, polygon, cover, velocity, spin, priority);
}

/// By how much bodies in a pit come to lie elsewhere if the scene lists them from the last to the first, m.
double moved_by_order(std::vector<std::string> bodies, double end) {
  WorkingScene text;
  text.gravity = "[0, -9.81]";
  text.law = R"(overlap_area", "roles": "priority)";
  text.material = R"("density": 2500, "model": "linear_elastic", "young_modulus": 1e8, "poisson_ratio": 0.2},
      "light": {"density": 1500, "model": "linear_elastic", "young_modulus": 3e8, "poisson_ratio": 0.2)";
  text.interface = R"("normal_stiffness": 2e7, "tangential_stiffness": 1e7, "friction_angle": 25,
      "normal_damping": 0.3, "tangential_damping": 0.3)";
  text.time = fmt::format(R"({{"end": {}, "dt": 2e-4}})", end);
  text.rest = R"("limits": {"energy_residual": 1, "penetration": 1},)";
  std::map<std::string, Vec2> places;
  double moved = 0;
  for (int order = 0; order < 2; ++order) {
    text.bodies = box("floor", -3, -1, 5, 0, R"("fixed": true)") + "," +
                  box("left", -3, 0, -2.2, 5, R"("fixed": true)") + "," +
                  box("right", 4.2, 0, 5, 5, R"("fixed": true)");
    for (const std::string& body : bodies) text.bodies += ", " + body;
    const Simulation simulation = run_to_end(text);
    for (std::size_t i = 0; i < simulation.scene().bodies.size(); ++i) {
      const Vec2 now = simulation.body_motion(i).position;
      const Vec2 before = places.emplace(simulation.scene().bodies[i].name, now).first->second;
      moved = std::max({moved, std::abs(now.x - before.x), std::abs(now.y - before.y)});
    }
    std::reverse(bodies.begin(), bodies.end());
  }
  return moved;
}

}  // namespace

TEST_CASE("A strip that meets two pieces of a block keeps its friction, whatever order bodies are listed in",
          "[contact][strips]") {
  // Other strips meet it in a point of the cut between the pieces, and were one contact with it or not.
  const std::vector<std::string> bodies{
      tumbling("b0", "rock", "[[-0.791167, 1.690376], [-1.532976, 1.204163], [-0.716375, 0.767278]]",
               as_block, "[0.422, -0.274]", -6.15, 2),
      tumbling("b1", "light", "[[1.144889, 0.556182], [1.538567, 1.581366], [0.401976, 1.429645]]", as_block,
               "[0.556, -2.548]", 26.97, 2),
      tumbling("b2", "rock",
               "[[2.575853, 1.675795], [2.51904, 0.685858], [2.879017, 0.665199], [2.915171, 1.295159], "
               "[3.54513, 1.259006], [3.56579, 1.618983]]",
               as_lattice, "[1.033, -1.227]", -39.75, 0),
      tumbling("b3", "light",
               "[[-1.594106, 3.337047], [-1.037047, 2.705894], [-0.665764, 2.921308], [-0.573012, 3.452299], "
               "[-1.026069, 3.8384]]",
               as_block, "[-0.42, -0.597]", -11.08, 0),
      tumbling("b4", "light",
               "[[1.363799, 3.555358], [0.960753, 3.742738], [0.596954, 3.48738], [0.636201, 3.044642], "
               "[1.039247, 2.857262], [1.403046, 3.11262]]",
               as_lattice, "[1.862, -1.692]", 25.33, 1),
      tumbling("b5", "light",
               "[[3.38959, 3.725385], [2.493118, 3.68601], [2.507436, 3.36002], [3.077918, 3.385077], "
               "[3.102974, 2.814595], [3.428964, 2.828913]]",
               as_block, "[0.337, -0.287]", 36.4, 0)};
  CHECK(moved_by_order(bodies, 0.9) < 1e-9);
}

TEST_CASE("A strip with many sides in a row about it loses no corner to rounding", "[contact][strips]") {
  const std::vector<std::string> bodies{
      tumbling("b0", "rock",
               "[[-1.527521, 1.619385], [-1.408572, 0.577788], [-1.029809, 0.621042], [-1.105504, 1.283877], "
               "[-0.44267, 1.359572], [-0.485924, 1.738335]]",
               as_lattice, "[1.724, -2.086]", -5.29, 1),
      tumbling("b1", "rock",
               "[[1.530427, 0.95343], [1.24657, 1.730427], [0.469573, 1.44657], [0.75343, 0.669573]]",
               as_lattice, "[0.049, -0.617]", 25.0, 0),
      tumbling("b2", "rock",
               "[[3.644335, 1.073165], [3.008564, 1.856644], [2.355665, 1.326835], [2.514608, 1.130965], "
               "[2.971637, 1.501832], [3.289523, 1.110092], [2.832493, 0.739225], [2.991436, 0.543356]]",
               as_lattice, "[0.402, -1.931]", -29.36, 2),
      tumbling("b3", "rock", "[[-0.876624, 3.805617], [-1.514176, 3.219417], [-0.65805, 2.928095]]", as_block,
               "[0.06, -2.619]", 75.03, 0),
      tumbling("b4", "light",
               "[[1.149949, 2.577202], [1.683909, 3.577831], [0.850051, 4.022798], [0.716561, 3.772641], "
               "[1.300262, 3.461164], [1.033282, 2.960849], [0.449581, 3.272326], [0.316091, 3.022169]]",
               as_lattice, "[1.447, -1.659]", 60.94, 2),
      tumbling("b5", "light",
               "[[2.942386, 3.947792], [2.373217, 3.126516], [3.057614, 2.652208], [3.199906, 2.857527], "
               "[2.720828, 3.189543], [3.005413, 3.600181], [3.484491, 3.268165], [3.626783, 3.473484]]",
               as_block, "[-1.323, -0.038]", 66.02, 1)};
  CHECK(moved_by_order(bodies, 0.25) < 1e-9);
}
