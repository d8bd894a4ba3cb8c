#include "figures/runs.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <string>

using namespace talus;
using namespace talus::figures;

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

/// Where the corner of the block is in the end that a divided body has driven its tip past. The tip lies
/// wholly within the block, whose sides are stiff or soft; `turned` begins the block's polygon at another
/// corner.
Vec2 place_past_tip(bool turned) {
  const std::string polygon =
      turned
          ? R"("polygon": [[2.10244, 0.632187], [3.098525, 0.035017], [3.915614, 0.679765], [3.013141, 1.969911]],
                  "surfaces": {"stiff": [3, 0]})"
          : R"("polygon": [[3.915614, 0.679765], [3.013141, 1.969911], [2.10244, 0.632187], [3.098525, 0.035017]],
                  "surfaces": {"stiff": [1, 2]})";
  const Scene scene = from_text(R"({"talus": 1, "gravity": [1.483, -9.81],
    "materials": {
      "rock": {"density": 2300, "model": "linear_elastic", "young_modulus": 1e8, "poisson_ratio": 0.25, "damping_time": 1e-4},
      "soil": {"density": 1700, "model": "hypoelastic", "young_modulus": 1e8, "poisson_ratio": 0.3}},
    "cover": {"model": "block"}, "contact": {"model": "frictionless"},
    "interfaces": [{"between": ["*", "*"], "normal_stiffness": 1e8, "normal_damping": 0},
                   {"between": ["rock", "soil"], "normal_stiffness": 5e7, "normal_damping": 0.3},
                   {"between": ["hard", "stiff"], "normal_stiffness": 1e8, "normal_damping": 0}],
    "bodies": [
      {"name": "divided", "material": "rock", "velocity": [2.74, 0.745],
       "polygon": [[0.707677, 1.761846], [0.70505, 0.099108], [1.966176, 1.139047]], "surfaces": {"hard": [0, 2]},
       "cover": {"model": "hexagonal", "size": 0.439, "angle": 17, "slivers": "mass_scale"}},
      {"name": "block", "material": "soil", )" +
                                polygon + R"(}],
    "time": {"end": 0.24, "dt": 4e-4}})");
  Simulation simulation(scene, {});
  while (simulation.advance()) {
  }
  return simulation.body_motion(1).position;
}

}  // namespace

TEST_CASE("it does not matter where a polygon starts that a strip lies within", "[contact_models]") {
  CHECK(size_of(place_past_tip(false) - place_past_tip(true)) < 1e-11);
}

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
