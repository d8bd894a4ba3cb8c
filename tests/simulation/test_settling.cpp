#include "simulation/simulation.hpp"
#include "working_scene.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <string>

using namespace talus;

TEST_CASE("settling ends with velocities and clock at zero, and the counts start there",
          "[simulation][settle]") {
  WorkingScene text = resting_block();
  text.rest = R"("settle": {"duration": 0.3, "damping": 300},)";
  Simulation simulation(text.read(), {});
  simulation.settle();
  CHECK(simulation.time() == 0);
  CHECK(simulation.summary().settle_steps > 100);
  CHECK(simulation.summary().steps == 0);
  REQUIRE(simulation.advance());
  CHECK(simulation.time() == 0);
  const Motion at_start = simulation.body_motion(1);
  CHECK(at_start.displacement.x == 0);
  CHECK(at_start.displacement.y == 0);
  CHECK(at_start.rotation == 0);
  CHECK(std::abs(at_start.velocity.y) < 1e-12);
  CHECK(at_start.position.y ==
        Approx(0.5 - 2300 * 10 / 1e9 - 0.5 * 0.5 * 2300 * 10 * 0.9375 / 1e10).epsilon(1e-9));
  CHECK(simulation.ledger().external_work == 0);
  CHECK(simulation.ledger().global_damping_loss == 0);
  CHECK(simulation.ledger().contact == Approx(1e9 * 2.3e-5 * 2.3e-5).epsilon(1e-3));

  while (simulation.advance()) {
  }
  CHECK(std::abs(simulation.body_motion(1).displacement.y) < 1e-9);
  CHECK(std::abs(simulation.body_motion(1).velocity.y) < 1e-6);
}

TEST_CASE("what a body turned while settling does not count", "[simulation][settle]") {
  WorkingScene text = resting_block();
  text.cover = "rigid";
  text.bodies = box("base", -9, -1, 9, 0, R"("fixed": true)") + R"(, {"name": "a", "material": "rock",
                "polygon": [[0, 0.1], [1, 2.1], [-1, 3], [-1.5, 1]]})";
  text.rest = R"("settle": {"duration": 2, "damping": 2},)";
  Simulation simulation(text.read(), {});
  simulation.settle();
  REQUIRE(simulation.advance());
  CHECK(simulation.body_motion(1).rotation == 0);
  CHECK(simulation.body_motion(1).position.y < 1.4);
}

TEST_CASE("without a settle stage settling does nothing", "[simulation][settle]") {
  Simulation simulation(resting_block().read(), {});
  const std::string before = simulation.state_hash();
  simulation.settle();
  CHECK(simulation.state_hash() == before);
  CHECK(simulation.summary().settle_steps == 0);
}

TEST_CASE("initial and driven velocities begin after settling", "[simulation][settle]") {
  WorkingScene text = resting_block();
  text.bodies = box("base", -1, -1, 9, 0, R"("fixed": true)") + ", " +
                box("a", 0, 0, 2, 1, R"("velocity": [2, 0])") + ", " +
                box("b", 4, 0, 6, 1, R"("drive": {"x": 0.5})");
  text.rest = R"("settle": {"duration": 0.1, "damping": 300},)";
  Simulation simulation(text.read(), {});
  simulation.settle();
  CHECK(std::abs(simulation.body_motion(2).position.x - 5) < 1e-9);
  simulation.advance();
  CHECK(simulation.body_motion(1).velocity.x == Approx(2).epsilon(1e-3));
  CHECK(simulation.body_motion(2).velocity.x == Approx(0.5));
  CHECK(simulation.body_motion(2).displacement.x == 0);
}

TEST_CASE("what did not settle in time is told to be let go from rest, as it is", "[simulation][settle]") {
  WorkingScene text;
  text.bodies = box("floor", -1, -1, 2, 0, R"("fixed": true)") + "," + box("a", 0, 0.1, 1, 1);
  text.gravity = "[0, -10]";
  text.rest = R"("settle": {"duration": 0.05, "damping": 1, "until": 1e-9},)";
  Simulation simulation(text.read(), {});
  REQUIRE(simulation.settle());
  REQUIRE_FALSE(simulation.summary().warnings.empty());
  CHECK_THAT(simulation.summary().warnings[0],
             Catch::Contains("what is out of balance is let go from rest at t = 0"));
  CHECK(simulation.ledger().kinetic == 0);
}
