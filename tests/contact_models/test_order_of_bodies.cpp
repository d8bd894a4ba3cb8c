#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <string>

using namespace talus;

namespace {

/// [body] where its first corner is in the end. A block falls on the corner of a body of many elements, past
/// their strips.
std::map<std::string, Vec2> places(const std::string& law, bool exchanged) {
  WorkingScene text;
  text.law = law;
  text.cover = "block";
  text.gravity = "[0, -9.81]";
  text.material = R"("density": 1700, "model": "linear_elastic", "young_modulus": 1e8, "poisson_ratio": 0.3)";
  text.interface = law == "frictionless"
                       ? R"("normal_stiffness": 2e8, "normal_damping": 0)"
                       : R"("normal_stiffness": 2e8, "tangential_stiffness": 3e7, "friction_angle": 0,
                            "normal_damping": 0, "tangential_damping": 0)";
  const std::string divided = R"({"name": "divided", "material": "rock",
      "cover": {"model": "hexagonal", "size": 0.395, "slivers": "mass_scale"},
      "polygon": [[5.87878, 2.687125], [5.312875, 3.87878], [4.12122, 3.312875], [4.687125, 2.12122]]})",
                    falls = R"({"name": "falls", "material": "rock", "velocity": [0.5, -4],
      "polygon": [[4.5904, 3.8904], [5.9096, 3.8904], [5.9096, 5.2096], [4.5904, 5.2096]]})";
  text.bodies = exchanged ? falls + "," + divided : divided + "," + falls;
  text.time = R"({"end": 0.12, "dt": 1e-4})";
  text.rest = R"("limits": {"penetration": 0.9},)";
  const Simulation simulation = run_to_end(text);
  std::map<std::string, Vec2> found;
  for (std::size_t body = 0; body < 2; ++body)
    found[simulation.scene().bodies[body].name] =
        simulation.parts(body).front().loops.front().front().position;
  return found;
}

}  // namespace

TEST_CASE("the order of two bodies does not matter where one is hit past its strips", "[contact_models]") {
  for (const char* law : {"overlap_area", "frictionless"}) {
    INFO(law);
    const auto one = places(law, false), other = places(law, true);
    for (const char* body : {"divided", "falls"}) {
      INFO(body);
      CHECK(size_of(one.at(body) - other.at(body)) < 1e-11);
    }
  }
}
