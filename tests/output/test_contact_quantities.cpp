#include "output/history.hpp"
#include "output/sampled.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

using namespace talus;

namespace {

constexpr double dt = 2e-5;             ///< s
constexpr Vec2 pull{-3, -9.81};         ///< m/s²
constexpr double mass = 2300 * 0.9994;  ///< kg/m, of `box` in the corner

/// A tilted box that falls into the corner between a floor and a wall, both fixed.
WorkingScene in_a_corner(const std::string& law, const std::string& cover) {
  WorkingScene text;
  text.law = law;
  text.gravity = "[-3, -9.81]";
  text.bodies = box("floor", -1, -1, 4, 0, R"("fixed": true)") + "," +
                box("wall", -1, 0, 0, 3, R"("fixed": true)") + R"(, {"name": "box", "material": "rock",
      "polygon": [[0.6, 0.001], [1.4, 0.601], [0.801, 1.401], [0.001, 0.801]], "cover": )" +
                cover + "}";
  text.interface = R"("normal_stiffness": 1e8, "tangential_stiffness": 1e8, "friction_angle": 20,
                      "normal_damping": 0.2, "tangential_damping": 0.2)";
  text.time = R"({"end": 0.2, "dt": 2e-5})";
  text.output = R"({"history": 2e-5})";
  return text;
}

}  // namespace

TEST_CASE("contact forces on a body are what changes its momentum, dashpots and friction included",
          "[output][history][contact]") {
  const char *rigid = R"({"model": "rigid"})", *block = R"({"model": "block"})",
             *many = R"({"model": "hexagonal", "size": 0.4})";
  for (const auto& [law, cover] : {std::pair{"overlap_area", rigid},
                                   {"overlap_area", block},
                                   {"overlap_area", many},
                                   {"vertex_edge", rigid},
                                   {"vertex_edge", block}}) {
    INFO(law << ", " << cover);
    Simulation simulation(in_a_corner(law, cover).read(), {});
    REQUIRE(simulation.advance());
    Vec2 velocity = simulation.body_motion(2).velocity, force, largest;
    double missed = 0;
    while (simulation.advance()) {
      const Vec2 v = simulation.body_motion(2).velocity;
      const Vec2 now = contact_sum(simulation.contacts(), 2, {}).force;
      // v at t_n is the mean of those before and after it: a step brings half of the force at either end.
      const auto expected = [&](double before, double after, double g) {
        return dt * ((before + after) / (2 * mass) + g);
      };
      missed = std::max({missed, std::abs(v.x - velocity.x - expected(force.x, now.x, pull.x)),
                         std::abs(v.y - velocity.y - expected(force.y, now.y, pull.y))});
      largest = {std::max(largest.x, now.x), std::max(largest.y, now.y)};
      velocity = v, force = now;
    }
    // Between strips of a body of many elements a remainder is left over, beside what is reported.
    CHECK(missed <= (cover == many ? 1e-5 : 1e-9) * dt * 9.81);
    CHECK(largest.x > mass * 3);
    CHECK(largest.y > mass * 9.81);
  }
}

TEST_CASE("monitors see what a floor and a wall carry, and where", "[output][history][contact]") {
  WorkingScene text;
  text.gravity = "[-3, -9.81]";
  text.bodies = box("floor", -1, -1, 4, 0, R"("fixed": true)") + "," +
                box("wall", -1, 0, 0, 3, R"("fixed": true)") + "," + box("box", 0, 0, 2, 1);
  text.rest = R"("damping": 300,)";
  text.interface = R"("normal_stiffness": 1e8, "tangential_stiffness": 1e8, "friction_angle": 0,
                      "normal_damping": 0, "tangential_damping": 0)";
  text.time = R"({"end": 0.5})";
  Scene scene = text.read();
  const std::vector<std::string> all{"contact_fx", "contact_fy", "contact_moment"};
  scene.monitors = {{"floor", 0, Vec2{0, 0}, all},
                    {"wall", 1, Vec2{0, 0}, all},
                    {"box", 2, {}, all},
                    {"motion", 2, {}, {"ux"}}};
  CHECK(monitor_columns(scene)[2] == "floor.contact_moment [N]");
  CHECK(monitor_columns(scene)[4] == "wall.contact_fy [N/m]");
  Simulation simulation(std::move(scene), {});
  while (simulation.advance()) {
  }
  const std::vector<double> values = sample_monitors(simulation);
  REQUIRE(values.size() == 10);
  const double weight = 2 * 2300.0;
  const auto is = [&](std::size_t i, double expected) {
    INFO(i);
    CHECK(values[i] == Approx(expected).epsilon(1e-4).margin(1e-4 * 9.81 * weight));
  };
  is(0, 0), is(1, -9.81 * weight);
  is(3, -3 * weight), is(4, 0);
  is(6, 3 * weight), is(7, 9.81 * weight), is(8, 0);
  // Nothing rubs, so both act through the middle of the box, that of the wall half a metre above the floor.
  CHECK(values[2] + values[5] == Approx(-9.81 * weight * 1 + 3 * weight * 0.5).epsilon(1e-4));
}
