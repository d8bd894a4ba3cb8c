#include "simulation/simulation.hpp"
#include "working_scene.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace talus;

namespace {

const std::string below = R"("surfaces": {"below": [0]})";

}  // namespace

TEST_CASE("a body sinks into its penalty support by its weight over the stiffness", "[simulation][loads]") {
  WorkingScene text;
  text.gravity = "[0, -10]";
  text.bodies = box("a", 0, 0, 2, 1, below);
  text.rest = R"("damping": 600, "prescribed": [{"body": "a", "surface": "below", "stiffness": 1e9,
                  "displacement": [0, 0]}],)";
  const Simulation simulation = run_to_end(text);
  CHECK(simulation.body_motion(0).displacement.y == Approx(-2300 * 10 / 1e9).epsilon(1e-9));
  CHECK(simulation.body_motion(0).displacement.x == Approx(0).margin(1e-15));
  // λ/2 ∫ u² over 2 m.
  CHECK(simulation.ledger().contact == Approx(1e9 * 2.3e-5 * 2.3e-5).epsilon(1e-8));
  CHECK(residual_share(simulation.ledger()) < 1e-3);
}

TEST_CASE("an axis without prescription is free", "[simulation][loads]") {
  WorkingScene text;
  text.gravity = "[1, -10]";
  text.bodies = box("a", 0, 0, 1, 1, below);
  text.rest = R"("prescribed": [{"body": "a", "surface": "below", "stiffness": 1e9,
                  "displacement": [null, 0]}],)";
  CHECK(run_to_end(text).body_motion(0).displacement.x == Approx(0.5).epsilon(1e-9));
}

TEST_CASE("a penalty support of uneven displacement turns the body back", "[simulation][loads]") {
  // A couple F b on a support of length 1: rotation F b / (λ/12), for small angles.
  WorkingScene text;
  text.bodies = box("a", 0, 0, 1, 1, below);
  text.rest = R"("damping": 600, "loads": [{"body": "a", "point": [0, 0.5], "force": [0, -100]},
                  {"body": "a", "point": [1, 0.5], "force": [0, 100]}],
                 "prescribed": [{"body": "a", "surface": "below", "stiffness": 1e9,
                  "displacement": [0, 0]}],)";
  const Simulation simulation = run_to_end(text);
  CHECK(simulation.body_motion(0).rotation == Approx(100 / (1e9 / 12)).epsilon(1e-4));
  CHECK(simulation.point_motion(0, {0.5, 0}).displacement.y == Approx(0).margin(1e-10));
}

TEST_CASE("a moving support pulls the body along, and the ledger knows its work", "[simulation][loads]") {
  WorkingScene text;
  text.bodies = box("a", 0, 0, 1, 1, below);
  text.time = R"({"end": 0.5, "safety": 0.05})";
  for (const char* motion : {R"("ramp": 0.1, "displacement": [0.01, 0])", R"("velocity": [0.2, 0])",
                             R"("ramp": 0.05, "displacement": [-0.01, 0.02], "velocity": [0.2, null])"}) {
    INFO(motion);
    text.rest = R"("prescribed": [{"body": "a", "surface": "below", "stiffness": 1e8, )" +
                std::string(motion) + "}],";
    const Simulation simulation = run_to_end(text);
    const EnergyLedger& ledger = simulation.ledger();
    CHECK(ledger.external_work > 0);
    CHECK(ledger.kinetic + ledger.contact == Approx(ledger.external_work).epsilon(2e-3));
    CHECK(simulation.summary().largest_residual_share < 5e-3);
  }
  text.rest = R"("damping": 150, "prescribed": [{"body": "a", "surface": "below", "stiffness": 1e8,
                  "ramp": 0.1, "displacement": [0.01, 0]}],)";
  CHECK(run_to_end(text).body_motion(0).displacement.x == Approx(0.01).epsilon(1e-6));
}

TEST_CASE("a support goes on from where it is when a stage gives it another motion", "[simulation][loads]") {
  WorkingScene text;
  text.bodies = box("a", 0, 0, 1, 1, below);
  text.time = R"({"end": 1})";
  text.output = R"({"history": 0.05})";
  const auto run = [&](const std::string& motion, const std::string& set, double at, double expected) {
    CAPTURE(motion, set, at);
    text.rest = R"("damping": 200, "prescribed": [)" + motion +
                R"(], "stages": [{"name": "on", "from": 0.5, "set": {)" + set + "}}],";
    Simulation simulation(text.read(), {});
    double furthest = 0, last = 0;
    while (simulation.advance() && simulation.time() <= at + 1e-9) {
      const double x = simulation.body_motion(0).displacement.x;
      furthest = std::max(furthest, std::abs(x - last));
      last = x;
    }
    CHECK(last == Approx(expected).margin(4e-4));
    CHECK(furthest < 0.016);  // no more than 0.2 m/s, and what drags behind
    CHECK(simulation.summary().largest_residual_share < 2e-2);
  };
  const std::string support = R"({"body": "a", "surface": "below", "stiffness": 1e9, )";
  const auto moved = [&](const std::string& how) { return support + how + "}"; };
  run(moved(R"("velocity": [0.2, 0])"), R"("/prescribed/0/velocity": [0, 0])", 1, 0.1);
  run(moved(R"("velocity": [0.2, 0])"), R"("/prescribed/0/velocity": [-0.1, 0])", 1, 0.05);
  run(moved(R"("velocity": [{"time": [[0, 0], [0.5, 0.2], [1, 0]]}, 0])"),
      R"("/prescribed/0/velocity": [{"time": [[0, 0], [0.5, 0], [1, 0.2]]}, 0])", 1, 0.1);
  run(moved(R"("velocity": [0.2, 0])"), R"("/prescribed/0/stiffness": 2e9)", 1, 0.2);
  run(moved(R"("velocity": [0.2, 0])"),
      R"("/prescribed/0/velocity": [null, null], "/prescribed/0/displacement": [0.1, 0])", 1, 0.1);
  run(moved(R"("velocity": [0.2, 0])"),
      R"("/prescribed/0/velocity": [null, null], "/prescribed/0/displacement": [0.05, 0],
         "/prescribed/0/ramp": 0.5)",
      0.75, 0.075);
  run(moved(R"("displacement": [{"scale": 0.1, "time": [[0, 0], [1, 1]]}, 0])"),
      R"("/prescribed/0/displacement/1": 1e-3, "/prescribed/0/ramp": 0.4)", 0.7, 0.07);
  run(moved(R"("velocity": [0.1, 0])") + ", " + moved(R"("displacement": [0, 0])"),
      R"("/gravity": [0, 1e-9])", 1, 0.05);
  run(moved(R"("displacement": [0.02, 0], "ramp": 0.2)"), R"("/prescribed/0/displacement": [0.04, 0])", 0.6,
      0.03);
  run(moved(R"("displacement": [0.02, 0], "ramp": 1)"), R"("/prescribed/0/displacement": [0.03, 0])", 1,
      0.02);
  run(moved(R"("displacement": [0.02, 0], "ramp": 0.2)"), R"("/prescribed/0/stiffness": 2e9)", 1, 0.02);
  run(moved(R"("displacement": [0.02, 0], "ramp": 0.2)"),
      R"("/prescribed/0/displacement": [null, null], "/prescribed/0/velocity": [0.1, 0])", 1, 0.07);
  run("", R"("/prescribed": [)" + moved(R"("velocity": [0.1, 0])") + "]", 1, 0.05);
  run("", R"("/prescribed": [)" + moved(R"("displacement": [0.04, 0], "ramp": 0.4)") + "]", 0.7, 0.02);
}

TEST_CASE("a point load works along the way of its point", "[simulation][loads]") {
  for (const char* cover : {"rigid", "block"}) {
    INFO(cover);
    WorkingScene text;
    text.cover = cover;
    text.bodies = box("a", 0, 0, 1, 1);
    text.rest = R"("loads": [{"body": "a", "point": [0.5, 0.5], "force": [2300, -4600]}],)";
    const Simulation simulation = run_to_end(text);
    CHECK(simulation.body_motion(0).displacement.x == Approx(0.5).epsilon(1e-9));
    CHECK(simulation.body_motion(0).displacement.y == Approx(-1).epsilon(1e-9));
    CHECK(simulation.ledger().external_work == Approx(2300 * 0.5 + 4600).epsilon(1e-9));
    CHECK(simulation.summary().largest_residual_share < 1e-10);
  }
}

TEST_CASE("a load that is shorter than a step gives its impulse, at the start and beside a stage",
          "[simulation][loads]") {
  const auto speed_after = [](const std::string& load, const std::string& stages) {
    WorkingScene text;
    text.bodies = box("a", 0, 0, 1, 1);
    text.rest = R"("loads": [{"body": "a", "point": [0.5, 0.5], "force": [)" + load + "}, 0]}]," + stages;
    text.time = R"({"end": 0.02, "dt": 2e-4})";
    return 2300 * run_to_end(text).body_motion(0).velocity.x;
  };
  CHECK(speed_after(R"({"scale": 1e5, "time": [[0, 0], [1e-4, 1], [2e-4, 0]])", "") == Approx(10));
  CHECK(speed_after(R"({"scale": 1e5, "time": [[0, 1], [1e-3, 0]])", "") == Approx(50));
  // The load is taken off at its peak, and where it has just fallen.
  const std::string off = R"("stages": [{"name": "off", "from": 0.01, "set": {"/loads/0/force": [0, 0]}}],)";
  CHECK(speed_after(R"({"scale": 1e5, "time": [[0.0099, 0], [0.01, 1], [0.0101, 0]])", off) == Approx(5));
  CHECK(speed_after(R"({"scale": 1e5, "time": [[0.0099, 1], [0.01, 0]])", off) == Approx(995));
  // It begins with a stage.
  CHECK(speed_after(R"({"scale": 0)",
                    R"("stages": [{"name": "on", "from": 0.01, "set": {"/loads/0/force":
                 [{"scale": 1e5, "time": [[0.01, 0], [0.0101, 1], [0.0102, 0]]}, 0]}}],)") == Approx(10));
}

TEST_CASE("an eccentric load turns the body by its moment", "[simulation][loads]") {
  WorkingScene text;
  text.bodies = box("a", 0, 0, 1, 1);
  text.rest = R"("loads": [{"body": "a", "point": [1, 0.5], "force": [0, 10]}],)";
  text.time = R"({"end": 0.5, "dt": 1e-3})";
  const Simulation simulation = run_to_end(text);
  CHECK(simulation.body_motion(0).rotation == Approx(10 * 0.5 / (2300 / 6.0) * 0.125).epsilon(1e-4));
  CHECK(simulation.summary().largest_residual_share < 1e-4);
}

TEST_CASE("a surface load over a part of a side is all of it, wherever it lies", "[simulation][loads]") {
  // 2e4 Pa on x in [1, 2] of a side of 10 m, with ramps of a millimetre; and the water on 30 m of a face of
  // 40 m.
  WorkingScene text;
  const double density = 2300;
  text.time = R"({"end": 0.001})";
  for (const std::string cover : {"rigid", "block"}) {
    text.cover = cover;
    text.bodies = box("a", -5, -1, 5, 0, R"("surfaces": {"top": [2]})");
    text.rest = R"("surface_loads": [{"body": "a", "surface": "top",
        "traction": [0, {"scale": -2e4, "x": [[0.999, 0], [1.001, 1], [1.999, 1], [2.001, 0]]}]}],)";
    const double strip = run_to_end(text).body_motion(0).velocity.y;
    CHECK(strip * density * 10 / 0.001 == Approx(-2e4).epsilon(1e-9));

    text.bodies = box("a", 0, 0, 20, 40, R"("surfaces": {"face": [3]})");
    text.rest = R"("surface_loads": [{"body": "a", "surface": "face",
        "pressure": {"scale": 1, "y": [[0, 294300], [30, 0]]}}],)";
    const double dam = run_to_end(text).body_motion(0).velocity.x;
    CHECK(dam * density * 800 / 0.001 == Approx(294300.0 * 30 / 2).epsilon(1e-5));
  }
}

TEST_CASE("a support whose motion varies along a side pulls as its mean", "[simulation][loads]") {
  // Lifted by 1 mm on [4, 6] of a foot of 10 m: by 0.2 mm in the mean.
  WorkingScene text;
  text.bodies = box("a", 0, 0, 10, 1, below);
  text.rest = R"("damping": 200, "prescribed": [{"body": "a", "surface": "below", "stiffness": 1e9,
      "displacement": [null, {"scale": 1e-3, "x": [[3.999, 0], [4.001, 1], [5.999, 1], [6.001, 0]]}]}],)";
  const Simulation simulation = run_to_end(text);
  CHECK(simulation.body_motion(0).displacement.y == Approx(2e-4).epsilon(1e-6));
}
