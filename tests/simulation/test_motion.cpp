#include "simulation/simulation.hpp"
#include "working_scene.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

using namespace talus;

namespace {

using std::numbers::pi;

}  // namespace

TEST_CASE("free flight is exact at every output, and so is its balance", "[simulation][motion]") {
  for (const char* cover : {"rigid", "block"}) {
    for (const char* time :
         {R"({"end": 0.5})", R"({"end": 0.5, "dt": 1e-3})", R"({"end": 0.5, "dt": 3e-4})"}) {
      INFO(cover << " " << time);
      WorkingScene text;
      text.cover = cover;
      text.gravity = "[1, -10]";
      text.bodies = box("a", 0, 0, 1, 1, R"("velocity": [3, 4])");
      text.time = time;
      text.output = R"({"history": 0.01})";
      Simulation simulation(text.read(), {});
      while (simulation.advance()) {
        const double t = simulation.time();
        const Motion motion = simulation.body_motion(0);
        REQUIRE(motion.displacement.x == Approx(3 * t + t * t / 2).margin(1e-12));
        REQUIRE(motion.displacement.y == Approx(4 * t - 5 * t * t).margin(1e-12));
        REQUIRE(motion.velocity.x == Approx(3 + t).margin(1e-11));
        REQUIRE(motion.velocity.y == Approx(4 - 10 * t).margin(1e-11));
        REQUIRE(residual_share(simulation.ledger()) < 1e-11);
      }
      CHECK(simulation.ledger().external_work == Approx(2300 * (3 * 0.5 + 0.125 - 10 * (2 - 1.25))));
    }
  }
}

TEST_CASE("a body that falls from rest keeps its balance in the coarsest of steps", "[simulation][motion]") {
  WorkingScene text;
  text.gravity = "[0, -10]";
  text.bodies = box("a", 0, 0, 1, 1);
  text.output = R"({"history": 0.1})";
  const Simulation simulation = run_to_end(text);
  CHECK(simulation.body_motion(0).displacement.y == Approx(-5).epsilon(1e-12));
  CHECK(simulation.summary().largest_residual_share < 1e-12);
}

TEST_CASE("a scene of one free body takes no contact step", "[simulation][motion]") {
  WorkingScene text;
  text.gravity = "[0, -10]";
  text.bodies = box("a", 0, 0, 1, 1);
  text.output = R"({"history": 0.05})";
  const Simulation simulation = run_to_end(text);
  CHECK(std::isinf(simulation.critical_dt()));
  CHECK(simulation.summary().steps == 20);
  CHECK(simulation.contacts().empty());
  CHECK(simulation.ledger().contact == 0);
}

TEST_CASE("mass-proportional damping slows a body as exp(-ct) and lets it fall no faster than g/c",
          "[simulation][motion]") {
  for (const char* cover : {"rigid", "block"}) {
    WorkingScene text;
    text.cover = cover;
    text.rest = R"("damping": 3,)";
    text.bodies = box("a", 0, 0, 1, 1, R"("velocity": [2, 0], "angular_velocity": 20)");
    text.time = R"({"end": 1, "dt": 1e-4})";
    text.output = R"({"history": 0.1})";
    Simulation simulation(text.read(), {});
    while (simulation.advance()) {
      const double t = simulation.time();
      CHECK(simulation.body_motion(0).velocity.x == Approx(2 * std::exp(-3 * t)).epsilon(1e-7));
      CHECK(simulation.body_motion(0).rotation ==
            Approx(pi / 9 * (1 - std::exp(-3 * t)) / 3).epsilon(1e-5).margin(1e-12));
      CHECK(residual_share(simulation.ledger()) < 1e-6);
    }
    CHECK(simulation.ledger().global_damping_loss == Approx(2300 * 2.0).epsilon(0.02));

    text.bodies = box("a", 0, 0, 1, 1);
    text.gravity = "[0, -10]";
    text.time = R"({"end": 10, "dt": 1e-3})";
    CHECK(run_to_end(text).body_motion(0).velocity.y == Approx(-10 / 3.0).epsilon(1e-9));
  }
}

TEST_CASE("a free body spins a hundred turns and keeps its energy", "[simulation][motion]") {
  for (const char* cover : {"rigid", "block"}) {
    INFO(cover);
    WorkingScene text;
    text.cover = cover;
    text.bodies = box("a", 0, 0, 1, 0.5, R"("velocity": [0.5, 0], "angular_velocity": 3600)");
    text.time = R"({"end": 10})";
    text.output = R"({"history": 0.013})";
    const Simulation simulation = run_to_end(text);
    const EnergyLedger& ledger = simulation.ledger();
    const double inertia = 1150 * (1 + 0.25) / 12, energy = (1150 * 0.25 + inertia * 400 * pi * pi) / 2;
    CHECK(ledger.kinetic + ledger.strain == Approx(energy).epsilon(1e-4));
    CHECK(simulation.summary().largest_residual_share < 1e-4);
    CHECK(simulation.body_motion(0).rotation == Approx(200 * pi).epsilon(1e-3));
    CHECK(simulation.body_motion(0).displacement.x == Approx(5).epsilon(1e-10));
  }
}

TEST_CASE("turns are counted however far the outputs lie apart", "[simulation][motion]") {
  for (const char* cover : {"rigid", "block"}) {
    for (const double sense : {1.0, -1.0}) {
      WorkingScene text;
      text.cover = cover;
      text.bodies = box("a", 0, 0, 1, 1, fmt::format(R"("angular_velocity": {})", sense * 2700));
      text.output = R"({"history": 1})";  // seven and a half turns
      CHECK(run_to_end(text).body_motion(0).rotation == Approx(sense * 15 * pi).epsilon(1e-3));
    }
  }
}

TEST_CASE("a fixed axis stays where it is and does no work", "[simulation][motion]") {
  for (const char* cover : {"rigid", "block"}) {
    INFO(cover);
    WorkingScene text;
    text.cover = cover;
    text.gravity = "[0, -10]";
    text.bodies = box("a", 0, 0, 1, 1, R"("fix": ["y", "rotation"], "velocity": [1, 0])");
    text.rest = R"("loads": [{"body": "a", "point": [1, 1], "force": [1000, 500]}],)";
    text.time = R"({"end": 0.5, "dt": 5e-5})";
    const Simulation simulation = run_to_end(text);
    const Motion motion = simulation.body_motion(0);
    CHECK(motion.displacement.y == 0);
    CHECK(std::abs(motion.rotation) < 1e-8);
    CHECK(motion.displacement.x == Approx(0.5 + 1000 / 2300.0 * 0.125).epsilon(1e-9));
    // A strain of 1e-7 aside, all work is that of the horizontal load.
    CHECK(simulation.ledger().external_work == Approx(1000 * motion.displacement.x).epsilon(1e-4));
    CHECK(simulation.summary().largest_residual_share < 1e-6);
  }
}

TEST_CASE("a driven support moves as told and its work is booked", "[simulation][motion]") {
  for (const char* cover : {"rigid", "block"}) {
    INFO(cover);
    WorkingScene text;
    text.cover = cover;
    text.rest = R"("damping": 2,)";
    text.bodies = box("a", 0, 0, 1, 1, R"("drive": {"x": 0.5}, "fix": ["y", "rotation"])");
    text.time = R"({"end": 2, "dt": 1e-3})";
    if (std::string(cover) == "block") text.time = R"({"end": 2, "dt": 4e-5})";
    const Simulation simulation = run_to_end(text);
    CHECK(simulation.body_motion(0).displacement.x == Approx(1).epsilon(1e-12));
    // Force c m v over v t, all of it lost to the damping.
    CHECK(simulation.ledger().external_work == Approx(2 * 2300 * 0.5 * 1).epsilon(1e-9));
    CHECK(simulation.ledger().global_damping_loss == Approx(2 * 2300 * 0.5 * 1).epsilon(1e-9));
    CHECK(residual_share(simulation.ledger()) < 1e-9);

    text.rest = "";
    text.bodies = box("a", 0, 0, 1, 1, R"("drive": {"rotation": 90})");
    const Simulation turning = run_to_end(text);
    CHECK(turning.body_motion(0).rotation == Approx(pi).epsilon(1e-4));
    CHECK(residual_share(turning.ledger()) < 1e-4);
  }
}

TEST_CASE("lifting a body against gravity costs its weight times the height", "[simulation][motion]") {
  WorkingScene text;
  text.gravity = "[0, -10]";
  text.bodies = box("a", 0, 0, 1, 1, R"("drive": {"y": 2})");
  text.output = R"({"history": 0.1})";
  const Simulation simulation = run_to_end(text);
  CHECK(simulation.body_motion(0).displacement.y == Approx(2).epsilon(1e-12));
  // The reaction m g and gravity −m g work against each other: nothing is left.
  CHECK(simulation.ledger().external_work == Approx(0).margin(1e-8 * 2300 * 10 * 2));
  CHECK(simulation.summary().largest_residual_share < 1e-10);
}

TEST_CASE("a head-on frictionless collision keeps momentum to round-off", "[simulation][motion]") {
  for (const char* law : {"overlap_area", "frictionless", "vertex_edge"}) {
    INFO(law);
    WorkingScene text;
    text.law = law;
    text.cover = "block";
    text.interface = R"("normal_stiffness": 1e9, "tangential_stiffness": 0, "friction_angle": 0,
                        "normal_damping": 0, "tangential_damping": 0)";
    text.bodies = box("a", 0, 0, 1, 1, R"("velocity": [1, 0])") + ", " + box("b", 1.1, 0, 2.1, 1);
    for (const double safety : {0.2, 0.1}) {
      text.time = fmt::format(R"({{"end": 0.3, "safety": {}}})", safety);
      const Simulation simulation = run_to_end(text);
      const double a = simulation.body_motion(0).velocity.x, b = simulation.body_motion(1).velocity.x;
      CHECK(a + b == Approx(1).epsilon(1e-12));
      CHECK(b > 0.99);
      CHECK(simulation.summary().largest_residual_share < 0.02);
      // At most (ωΔt)²/8 for each of the two kinks of a contact, of the energy of approach, half of what
      // there is; ω² = 2α L/m.
      const double turn = std::sqrt(2 * 1e9 / 2300) * simulation.summary().dt;
      CHECK(turn < 2 * safety);
      CHECK(residual_share(simulation.ledger()) < turn * turn / 8);
    }
  }
}

TEST_CASE("dashpots across a contact do not feed the strain of a block that slides", "[simulation][motion]") {
  const double slope = 35 * std::numbers::pi / 180, friction = 37 * std::numbers::pi / 180, g = 9.81;
  // With a wall at its end the base is concave, and the pair goes the general way.
  const std::string concave =
      R"({"name": "base", "material": "rock", "fixed": true,
          "polygon": [[-10, -1], [60, -1], [60, 5], [59, 5], [59, 0], [-10, 0]]})";
  for (const std::string& base : {box("base", -10, -1, 60, 0, R"("fixed": true)"), concave}) {
    CAPTURE(base);
    WorkingScene text;
    text.gravity = fmt::format("[{:.17g}, {:.17g}]", g * std::sin(slope), -g * std::cos(slope));
    text.cover = "block";
    text.material =
        R"("density": 2500, "model": "linear_elastic", "young_modulus": 1e10, "poisson_ratio": 0.2)";
    text.interface = R"("normal_stiffness": 1e9, "tangential_stiffness": 1e9, "friction_angle": 37,
                        "normal_damping": 0.3, "tangential_damping": 0.3)";
    text.bodies = base + "," + box("block", 0, 0, 2, 0.5, R"("velocity": [3, 0])");
    text.rest = R"("settle": {"duration": 0.5, "damping": 200},)";
    text.time = R"({"end": 2.5})";
    Simulation simulation(text.read(), {});
    simulation.settle();
    while (simulation.advance()) {
    }
    const double along = g * (std::sin(slope) - std::tan(friction) * std::cos(slope));
    CHECK(simulation.body_motion(1).velocity.x == Approx(3 + along * 2.5).epsilon(1e-4));
    CHECK(simulation.body_motion(1).displacement.x == Approx(3 * 2.5 + along * 2.5 * 2.5 / 2).epsilon(1e-4));
  }
}

#if defined(__x86_64__)

TEST_CASE("motion that dies away ends in 0, not in subnormal numbers", "[simulation][motion]") {
  for (const char* cover : {"rigid", "block"}) {
    CAPTURE(cover);
    WorkingScene text;
    text.cover = cover;
    text.bodies = box("a", 0, 0, 1, 1, R"("velocity": [1e-300, 0])");
    text.rest = R"("damping": 10, )";
    text.time = R"({"end": 2.5, "dt": 1e-4})";
    text.output = R"({"history": 0.5})";
    Simulation simulation(text.read(), {});
    std::vector<double> speeds;
    while (simulation.advance()) speeds.push_back(simulation.body_motion(0).velocity.x);
    REQUIRE(speeds.size() == 6);
    for (std::size_t i = 0; i < 4; ++i)
      CHECK(speeds[i] == Approx(1e-300 * std::exp(-5.0 * static_cast<double>(i))).epsilon(1e-3));
    CHECK(speeds[4] == 0);
    CHECK(speeds[5] == 0);
  }
}

#endif

TEST_CASE("a block that sticks rests: dashpots do not move the place of its friction", "[simulation]") {
  // A dam of 20 m, which friction of 50 degrees holds with a factor of 1.69 against water on its face.
  const std::string law = GENERATE("overlap_area", "cohesive_overlap");
  INFO(law);
  WorkingScene text;
  text.gravity = "[0, -9.81]";
  text.law = law;
  text.material =
      R"("density": 2400, "model": "linear_elastic", "young_modulus": 2.5e10, "poisson_ratio": 0.2)";
  text.interface = R"("normal_stiffness": 1e9, "tangential_stiffness": 1e9, "friction_angle": 50,
                      "normal_damping": 0.3, "tangential_damping": 0.3)";
  text.bodies = box("ground", -20, -10, 40, 0, R"("fixed": true)") + R"(,
      {"name": "dam", "material": "rock", "polygon": [[0, 0], [16, 0], [4, 15], [4, 20], [0, 20]],
       "cover": {"model": "block"}, "surfaces": {"face": [4], "base": [0]}})";
  text.rest = R"("settle": {"duration": 2, "damping": "adaptive", "until": 1e-4}, "surface_loads": [
      {"body": "dam", "surface": "face", "traction": [{"scale": 9810, "y": [[0, 19], [19, 0]]}, 0]},
      {"body": "dam", "surface": "base", "traction": [0, {"scale": 9810, "x": [[0, 19], [16, 0]]}]}],)";
  text.time = R"({"end": 3})";
  Simulation simulation(text.read(), {});
  REQUIRE(simulation.settle());
  while (simulation.advance()) {
  }
  CHECK(std::abs(simulation.body_motion(1).displacement.x) < 1e-6);
}
