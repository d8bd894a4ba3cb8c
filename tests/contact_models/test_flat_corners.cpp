// Corners of faces that lie flat on each other under `vertex_edge`: over corners, over joints, at flanks.
#include "contact_models/block_on_base.hpp"
#include "simulation/working_scene.hpp"

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <string>

using namespace talus;
using namespace talus::bench;

TEST_CASE("Obtuse corners over obtuse corners stand on the faces, not on the flanks behind them",
          "[laws][vertex_edge]") {
  // Two faces of a metre, flush, whose flanks rise and fall by this angle; a regular hexagon has 60 degrees.
  for (const double degrees : {20.0, 30.0, 45.0, 60.0, 80.0, 89.0}) {
    INFO(degrees);
    const double angle = degrees / 180 * 3.14159265358979, out = std::cos(angle), up = std::sin(angle);
    LawBench bench("vertex_edge", undamped_interface());
    constexpr double depth = 1e-4;
    bench.bodies = {
        held({{-0.5 - out, -up}, {-0.5, -2}, {0.5, -2}, {0.5 + out, -up}, {0.5, 0}, {-0.5, 0}}),
        held({{-0.5, -depth}, {0.5, -depth}, {0.5 + out, up}, {0.5, 2}, {-0.5, 2}, {-0.5 - out, up}})};
    const Evaluation found = bench.step();
    CHECK(found.on(1).y == Approx(1e9 * depth).epsilon(1e-9));
    CHECK(std::abs(found.on(1).x) < 1e-6 * found.on(1).y);
    CHECK(found.pairs[0].penetration == Approx(depth).epsilon(1e-9));
  }
}

TEST_CASE("A block slides over a joint between two bodies as over one", "[laws][vertex_edge]") {
  // Its corner is deep behind the hidden flank of the second, too, and nearer to that for as far as it is
  // deep.
  const double damping = GENERATE(0.0, 0.3);
  const std::string cover = GENERATE("rigid", "block");
  INFO(damping << ", " << cover);
  WorkingScene text;
  text.law = "vertex_edge";
  text.cover = cover;
  text.interface = fmt::format(R"("normal_stiffness": 1e8, "tangential_stiffness": 1e8, "friction_angle": 0,
                                  "normal_damping": {0}, "tangential_damping": {0})",
                               damping);
  text.bodies = box("first", 0, -1, 1.5, 0, R"("fixed": true)") + "," +
                box("second", 1.5, -1, 3, 0, R"("fixed": true)") + "," +
                box("block", 0.4995, 0, 1.4995, 0.5, R"("velocity": [0.1, 0])");
  text.gravity = "[0, -10]";
  text.rest = R"("settle": {"duration": 0.2, "damping": 200},)";
  text.time = R"({"end": 0.1})";
  Simulation simulation(text.read(), {});
  REQUIRE(simulation.settle());
  const double rest = simulation.body_motion(2).position.y;
  double lifted = 0;
  while (simulation.advance())
    lifted = std::max(lifted, std::abs(simulation.body_motion(2).position.y - rest));
  const double sunk = 0.25 - rest;
  CHECK(simulation.body_motion(2).velocity.x == Approx(0.1).epsilon(1e-2));
  CHECK(lifted < 0.01 * sunk);
  CHECK(simulation.body_motion(2).position.x > 1.008);
}

TEST_CASE("A corner past an outward bend sinks without a jump of force", "[laws][vertex_edge]") {
  // Once it is as deep as it is past the bend, the corner of the bend is near it, but bears on another
  // stretch.
  LawBench bench("vertex_edge", undamped_interface());
  bench.bodies = {held({{-1, -0.1227845609029046}, {-1, -2}, {1, -2}, {1, 0}, {0, 0}}),
                  box(-0.0006, 0, 0.5994, 0.5)};
  double before = 0;
  for (int i = 1; i <= 120; ++i) {
    const double force = shifted(bench, {0, -1e-5}).on(1).y;
    CHECK(force > before);
    before = force;
  }
  CHECK(before == Approx(1e9 * 0.6 * 1.2e-3).epsilon(0.05));
}

TEST_CASE("A heap of cells comes to rest where three of them meet", "[laws][vertex_edge]") {
  // There a vertex is behind a face and behind a flank that its own edge goes into, the less deep of the two.
  WorkingScene text;
  text.law = "vertex_edge";
  text.interface = R"("normal_stiffness": 2.4473701024944286e9, "tangential_stiffness": 2.4473701024944286e9,
                      "friction_angle": 45, "normal_damping": 0.3, "tangential_damping": 0.3)";
  text.bodies = box("base", -1, -1, 4, 0, R"("fixed": true)");
  text.gravity = "[0, -10]";
  text.rest = R"("settle": {"duration": 0.3, "damping": "adaptive", "hold_stick": false},
                 "blocks": [{"name": "cell", "domain": [[0, 0], [3, 0], [3, 2], [0, 2]], "material": "rock",
                             "voronoi": {"count": 7, "seed": 38}, "smallest_share": 0.1}],)";
  text.time = R"({"end": 0.02})";
  Simulation simulation(text.read(), {});
  REQUIRE(simulation.settle());
  while (simulation.advance()) {
  }
  for (std::size_t body = 1; body < simulation.scene().bodies.size(); ++body) {
    const Vec2 velocity = simulation.body_motion(body).velocity;
    CHECK(std::hypot(velocity.x, velocity.y) < 1e-7);
  }
  CHECK(simulation.summary().largest_residual_share < 1e-6);
}

TEST_CASE("What is drawn flush is bonded, whatever rounding makes of it", "[laws][vertex_edge][bonds]") {
  const Values bonded = with(undamped_interface(), {{"cohesion", 2e5}, {"tensile_strength", 1e5}});
  const auto holds = [&](double gap) {
    LawBench bench("vertex_edge", bonded);
    bench.bodies = block_on_base(-gap);
    bench.bonds_form = true;
    bench.step();
    bench.bonds_form = false;
    return -shifted(bench, {0, 5e-5}).on(1).y;
  };
  for (const double gap : {0.0, 1e-12, 1e-10, 9e-10}) CHECK(holds(gap) == Approx(5e4).epsilon(1e-4));
  CHECK(holds(1e-8) == 0);
}

TEST_CASE("friction takes energy from a block that spins on its corners, and gives none",
          "[laws][vertex_edge]") {
  // As it turns, its corners face less of the floor while they stick: their springs get softer.
  WorkingScene text;
  text.law = "vertex_edge";
  text.material = R"("density": 2000, "model": "linear_elastic", "young_modulus": 1e9, "poisson_ratio": 0.2)";
  text.interface = R"("normal_stiffness": 2e7, "tangential_stiffness": 2e7, "friction_angle": 75,
                      "normal_damping": 0, "tangential_damping": 0)";
  text.bodies = box("floor", -5, -1, 5, 0, R"("fixed": true)") + R"(, {"name": "block", "material": "rock",
      "polygon": [[0.364, 0], [0.558, 0.461], [-0.364, 0.849], [-0.558, 0.388]],
      "velocity": [4, -1.6], "angular_velocity": -127})";
  text.time = R"({"end": 0.05, "dt": 1e-5})";
  Simulation simulation(text.read(), {});
  double before = 0, least = 0;
  while (simulation.advance()) {
    const double loss = simulation.ledger().friction_loss;
    least = std::min(least, loss - before);
    before = loss;
  }
  CHECK(before > 100);
  CHECK(least > -1e-6);
}
