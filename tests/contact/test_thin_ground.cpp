#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <string>

using namespace talus;

namespace {

/// How often a run in which a block falls on a body of many elements warns that it goes too deep. A joint
/// lies `below` the surface, m.
std::ptrdiff_t warnings_of(double below, double speed) {
  WorkingScene text;
  text.law = "frictionless";
  text.material = R"("density": 2000, "model": "linear_elastic", "young_modulus": 1e9, "poisson_ratio": 0.2)";
  text.interface = R"("normal_stiffness": 1e8, "normal_damping": 0.5)";
  text.bodies = box("floor", -1, -1, 3, 0, R"("fixed": true)") + ", " +
                box("base", 0, 0, 2, 1,
                    fmt::format(R"("cover": {{"model": "hexagonal", "size": 0.2}},
                         "discontinuities": [{{"points": [[-0.1, {0}], [2.1, {0}]]}}])",
                                1 - below)) +
                ", " + box("block", 0.7, 1, 1.3, 1.6, fmt::format(R"("velocity": [0, {}])", -speed));
  text.time = R"({"end": 0.01})";
  text.output = R"({"history": 0.001})";
  text.rest = R"("limits": {"energy_residual": 0.5}, )";
  const Simulation run = run_to_end(text);
  return std::ranges::count_if(run.summary().warnings, [](const std::string& warning) {
    return warning.find("deeper than contact sees") != std::string::npos;
  });
}

}  // namespace

TEST_CASE("a run warns once of an overlap behind what is thin, as deep as it is", "[contact][strips]") {
  CHECK(warnings_of(0.003, 3) == 1);
  CHECK(warnings_of(0.003, 0.1) == 0);
  CHECK(warnings_of(0.2, 3) == 0);
}
