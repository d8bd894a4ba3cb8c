// Dashpots along the normal of a contact.
#include "output/sampled.hpp"
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

namespace {

/// A block that hits a light wall at 1 m/s, which is held in some way; a notch above keeps it from the lanes.
WorkingScene hits_wall(const char* law, const char* cover, const std::string& how, const char* notch = "") {
  WorkingScene text;
  text.law = law;
  text.cover = cover;
  text.material = R"("density": 2000, "model": "linear_elastic", "young_modulus": 1e11, "poisson_ratio": 0.2},
                     "dummy": {"density": 20, "model": "linear_elastic", "young_modulus": 1e11, "poisson_ratio": 0.2)";
  text.interface = R"("normal_stiffness": 1e7, "tangential_stiffness": 0, "friction_angle": 0,
                      "normal_damping": 0.3, "tangential_damping": 0},
                      {"between": ["dummy", "*"], "normal_stiffness": 1e7, "tangential_stiffness": 0,
                       "friction_angle": 0, "normal_damping": 0.3, "tangential_damping": 0)";
  text.bodies = R"({"name": "wall", "material": "dummy", "polygon": [[-1, -1], [2, -1], [2, 0], [-1, 0]], )" +
                how + R"(}, {"name": "block", "material": "rock", "velocity": [0, -1],
                             "polygon": [[0, 1e-4], [1, 1e-4], [1, 1.0001])" +
                notch + R"(, [0, 1.0001]]})";
  text.time = R"({"end": 0.05, "dt": 2e-6})";
  return text;
}

}  // namespace

TEST_CASE("a wall that is held or driven is one that is fixed, whatever its mass", "[laws][damping]") {
  const std::string held = R"("fix": ["x", "y", "rotation"])",
                    driven = R"("drive": {"x": 0, "y": 0.5, "rotation": 0})";
  for (const char* law : {"overlap_area", "vertex_edge"}) {
    for (const char* cover : {"rigid", "block"}) {
      for (const char* notch : {"", ", [0.5, 0.8]"}) {
        INFO(law << ", " << cover << notch);
        const auto leaves = [&](const std::string& how) {
          return run_to_end(hits_wall(law, cover, how, notch)).body_motion(1).velocity.y;
        };
        const double due = leaves(R"("fixed": true)");
        CHECK(due > 0.3);
        CHECK(due < 0.6);
        CHECK(leaves(held) == Approx(due).epsilon(2e-3));
        WorkingScene pushed = hits_wall(law, cover, driven, notch);
        pushed.bodies.replace(pushed.bodies.find("[0, -1]"), 7, "[0, -0.5]");
        CHECK(run_to_end(pushed).body_motion(1).velocity.y - 0.5 == Approx(due).epsilon(2e-3));
      }
    }
  }
}

TEST_CASE("a wall that a stage holds is a fixed one from there on", "[laws][damping]") {
  const double due =
      run_to_end(hits_wall("overlap_area", "rigid", R"("fixed": true)")).body_motion(1).velocity.y;
  WorkingScene text = hits_wall("overlap_area", "rigid", R"("fix": ["x", "rotation"])");
  text.rest =
      R"("stages": [{"name": "held", "from": 5e-5, "set": {"/bodies/0/fix": ["x", "y", "rotation"]}}],)";
  CHECK(run_to_end(text).body_motion(1).velocity.y == Approx(due).epsilon(2e-3));
}

TEST_CASE("no step is made shorter for a light rigid wall that cannot move", "[damping][time]") {
  const auto step = [](const std::string& how) {
    WorkingScene text = hits_wall("overlap_area", "rigid", how);
    text.time = R"({"end": 0.01})";
    return run_to_end(text).present_bound().dt;
  };
  CHECK(step(R"("fix": ["x", "y", "rotation"])") == step(R"("fixed": true)"));
  CHECK(step(R"("fix": ["x", "y"])") < step(R"("fixed": true)") / 2);
}

TEST_CASE("two walls that are held and deform press on each other with their own masses", "[damping][time]") {
  for (const char* law : {"overlap_area", "vertex_edge"}) {
    INFO(law);
    WorkingScene text;
    text.law = law;
    text.cover = "block";
    text.material =
        R"("density": 2000, "model": "linear_elastic", "young_modulus": 1e9, "poisson_ratio": 0.2)";
    text.interface = R"("normal_stiffness": 1e11, "tangential_stiffness": 1e11, "friction_angle": 30,
                        "normal_damping": 1, "tangential_damping": 1)";
    text.bodies = box("held", 0, 0, 0.01, 0.01, R"("fix": ["x", "y", "rotation"])") + ", " +
                  box("driven", 0, 0.01, 0.01, 0.02, R"("drive": {"x": 0, "y": -0.01, "rotation": 0})");
    text.time = R"({"end": 0.002})";
    const Simulation simulation = run_to_end(text);
    CHECK(residual_share(simulation.ledger()) < 1e-3);
    CHECK(contact_sum(simulation.contacts(), 1, {}).force.y > 100);
  }
}

TEST_CASE("a deformable platen goes by the bodies beside it, not by the heaviest of the scene",
          "[damping][time]") {
  const auto steps = [](const char* far) {
    WorkingScene text;
    text.cover = "block";
    text.material =
        R"("density": 2000, "model": "linear_elastic", "young_modulus": 1e10, "poisson_ratio": 0.2)";
    text.interface = R"("normal_stiffness": 1e9, "tangential_stiffness": 1e9, "friction_angle": 30,
                        "normal_damping": 1, "tangential_damping": 1)";
    text.bodies = box("floor", -10, -1, 190, 0, R"("fixed": true)") + ", " + box("block", 0, 0, 1, 1) + ", " +
                  box("platen", -0.1, 1, 1.1, 1.1, R"("drive": {"x": 0, "y": -0.001, "rotation": 0})") + far;
    text.time = R"({"end": 0.002})";
    return run_to_end(text).summary().steps;
  };
  const auto alone = steps("");
  CHECK(alone > 100);
  CHECK(steps((", " + box("far", 60, 0, 120, 40)).c_str()) == alone);
}
