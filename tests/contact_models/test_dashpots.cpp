// Dashpots along the normal of a contact.
#include "output/quantity.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace talus;

TEST_CASE("dashpots of a wedge that leans do not pull it into the floor", "[laws][damping]") {
  // Of its two sides one looks away from the floor and presses against the other: what that one's dashpot may
  // take of its own spring is more than both springs push. A notch above keeps it from the lanes.
  for (const char* law : {"overlap_area", "cohesive_overlap", "frictionless"}) {
    for (const char* notch : {"", ", [0.5, 0.35]"}) {
      INFO(law << notch);
      WorkingScene text;
      text.law = law;
      text.material = R"("density": 2000)";
      text.interface = R"("normal_stiffness": 5e7, "tangential_stiffness": 0, "friction_angle": 0,
                          "normal_damping": 0.5, "tangential_damping": 0)";
      if (law == std::string("frictionless"))
        text.interface = R"("normal_stiffness": 5e7, "normal_damping": 0.5)";
      text.bodies = box("floor", -3, -1, 3, 0, R"("fixed": true)") + std::string(R"(,
        {"name": "wedge", "material": "rock", "velocity": [0, -1], "fix": ["x", "rotation"],
         "polygon": [[0, 0.001], [0.94, 0.343], [0.766, 0.643])") +
                    notch + "]}";
      // After a hundredth of a second something pulls it out.
      text.gravity = "[0, 0]";
      text.rest = R"("stages": [{"name": "pull", "from": 0.01, "set": {"/gravity": [0, 1000]}}],)";
      text.output = R"({"history": 2e-5})";
      text.time = R"({"end": 0.0115, "dt": 2e-5})";
      Simulation simulation(text.read(), {});
      double former = 0, slowest = 1e9;
      bool pressed = false;
      while (simulation.advance()) {
        const double speed = simulation.body_motion(1).velocity.y;
        if (simulation.time() > 0.0101) slowest = std::min(slowest, (speed - former) / 2e-5);
        former = speed;
        const double force = contact_sum(simulation.contacts(), 1, {}).force.y;
        pressed = pressed || force > 1e4;
        REQUIRE(force >= 0);
      }
      CHECK(pressed);
      CHECK(slowest > 1000 * (1 - 1e-6));
    }
  }
}
