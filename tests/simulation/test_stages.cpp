#include "simulation/simulation.hpp"
#include "working_scene.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <cmath>
#include <string>

using namespace talus;

TEST_CASE("a stage between two outputs begins on time and every output is still met",
          "[simulation][stages]") {
  WorkingScene text;
  text.bodies = box("a", 0, 0, 1, 1);
  text.time = R"({"end": 1, "dt": 0.01})";
  text.output = R"({"history": 0.25})";
  text.rest = R"("stages": [{"name": "pull", "from": 0.4, "set": {"/gravity": [2, 0]}}],)";
  const Scene scene = text.read();
  Simulation simulation(scene, {});
  std::vector<double> times;
  while (simulation.advance()) times.push_back(simulation.time());
  CHECK(times == std::vector<double>{0, 0.25, 0.5, 0.75, 1});
  const Motion motion = simulation.body_motion(0);
  // No part of the step that leads there is shared by both stages.
  CHECK(motion.velocity.x == Approx(2 * 0.6).epsilon(1e-12));
  CHECK(motion.displacement.x == Approx(0.6 * 0.6).epsilon(1e-12));
}

TEST_CASE("a stage that stiffens a closed contact is booked as work", "[simulation][stages]") {
  for (const char* stiffness : {"1e8", "1e10"}) {
    WorkingScene text;
    text.gravity = "[0, -10]";
    text.bodies = box("table", -3, -1, 3, 0, R"("fixed": true)") + ", " + box("a", -1, 0, 1, 1);
    text.interface = R"("normal_stiffness": 1e9, "tangential_stiffness": 1e9, "friction_angle": 30,
                        "normal_damping": 0.3, "tangential_damping": 0.3)";
    text.rest = fmt::format(R"("settle": {{"duration": 2, "damping": "adaptive", "until": 1e-8}},
      "stages": [{{"name": "other", "from": 0.1, "set": {{"/interfaces/0/normal_stiffness": {}}}}}],)",
                            stiffness);
    text.time = R"({"end": 0.3, "safety": 0.015})";
    const Scene scene = text.read();
    Simulation simulation(scene, {});
    simulation.settle();
    while (simulation.advance()) {
    }
    CHECK(simulation.ledger().throughput > 0.1);
    // Unbooked, the jump is 27 % and 73 %.
    CHECK(simulation.summary().largest_residual_share <= 1e-3);
  }
}

TEST_CASE("a stage that stiffens what friction holds is booked as work where nothing slips",
          "[simulation][stages]") {
  const std::string law = GENERATE("overlap_area", "cohesive_overlap", "vertex_edge");
  const double stiffness = GENERATE(1e8, 4e9);
  CAPTURE(law, stiffness);
  WorkingScene text;
  text.law = law;
  text.bodies = box("table", -3, -1, 3, 0, R"("fixed": true)") + ", " +
                box("a", -1, 0, 1, 1, R"("drive": {"x": 0, "y": -0.01, "rotation": 0})");
  text.interface = R"("normal_stiffness": 1e9, "tangential_stiffness": 1e9, "friction_angle": 30,
                      "normal_damping": 0, "tangential_damping": 0)";
  text.rest = fmt::format(
      R"("stages": [{{"name": "shear", "from": 0.1, "set": {{"/bodies/1/drive/x": 2e-4, "/bodies/1/drive/y": 0}}}},
                    {{"name": "other", "from": 0.2, "set": {{"/interfaces/0/tangential_stiffness": {},
                                                          "/bodies/1/drive/x": 0}}}}],)",
      stiffness);
  text.time = R"({"end": 0.3, "dt": 1e-4})";
  text.output = R"({"history": 0.05})";
  Simulation simulation(text.read(), {});
  while (simulation.advance()) {
  }
  // T = k l s with s = 0.02 mm on 2 m; T²/(2 k l), and what pressed them together, 0.5 α l d².
  const double sheared = 1e9 * 2 * 2e-5, held = sheared * sheared / 2 / (2 * stiffness);
  const EnergyLedger& ledger = simulation.ledger();
  const double at_start = 0.5 * 2300 * 2 * 0.01 * 0.01;  // J/m, of the motion downwards
  CHECK(ledger.contact - 1e9 * 1e-6 == Approx(held).epsilon(1e-2));
  CHECK(ledger.external_work + at_start == Approx(ledger.contact).epsilon(1e-7));
  CHECK(std::abs(ledger.friction_loss) < 1e-3 * held);
  CHECK(std::abs(ledger.residual) < 1e-5 * ledger.throughput);
}

TEST_CASE("a joint that becomes a hundred times as stiff springs open as it would at the new step",
          "[simulation][stages]") {
  for (const char* law : {"overlap_area", "vertex_edge"}) {
    CAPTURE(law);
    WorkingScene text;
    text.law = law;
    text.gravity = "[0, -10]";
    text.bodies = box("table", -3, -1, 3, 0, R"("fixed": true)") + ", " + box("a", -1, 0, 1, 1);
    text.interface = R"("normal_stiffness": 1e9, "tangential_stiffness": 1e9, "friction_angle": 30,
                        "normal_damping": 0, "tangential_damping": 0)";
    text.rest = R"("settle": {"duration": 2, "damping": "adaptive", "until": 1e-8},
      "stages": [{"name": "stiff", "from": 0.1, "set": {"/interfaces/0/normal_stiffness": 1e11}}],)";
    const auto top = [&text](const char* time) {
      text.time = time;
      Simulation simulation(text.read(), {});
      simulation.settle();
      while (simulation.advance()) {
      }
      CHECK(simulation.summary().largest_residual_share <= 0.03);
      return simulation.body_motion(1).velocity.y;
    };
    // Of the stiff joint's force in half of the long step before it came a third more.
    CHECK(top(R"({"end": 0.102})") == Approx(top(R"({"end": 0.102, "dt": 1e-6})")).epsilon(0.03));
  }
}

namespace {

struct Ends {
  double position, velocity, lost, residual;
};

/// At the end of a run of equal steps, a stage of which begins at one of them.
Ends ends_of(WorkingScene text, const std::string& stage) {
  text.rest += stage;
  const Simulation simulation = run_to_end(text);
  const EnergyLedger& l = simulation.ledger();
  const Motion motion = simulation.body_motion(1);
  return {motion.displacement.x + motion.displacement.y, motion.velocity.x + motion.velocity.y,
          l.friction_loss + l.contact_damping_loss + l.material_loss,
          simulation.summary().largest_residual_share};
}

}  // namespace

TEST_CASE("a stage that changes nothing changes nothing, whatever lasts from step to step",
          "[simulation][stages]") {
  WorkingScene text;
  text.gravity = "[0, -10]";
  text.bodies = box("base", -3, -1, 3, 0, R"("fixed": true)") + ", " +
                box("a", -1, 1e-4, 1, 1, R"("velocity": [0.5, -0.5])");
  text.time = R"({"end": 0.004, "dt": 1e-5})";
  text.output = R"({"history": 0.001})";
  const auto [material, cover, damping] =
      GENERATE(table<const char*, const char*, const char*>({{"linear_elastic", "block", "0"},
                                                             {"linear_elastic", "block", "0.3"},
                                                             {"linear_elastic", "rigid", "0.3"},
                                                             {"hypoelastic", "block", "0.1"},
                                                             {"mohr_coulomb", "block", "0"}}));
  const std::string law = GENERATE("overlap_area", "vertex_edge", "cohesive_overlap");
  CAPTURE(material, cover, damping, law);
  text.law = law;
  text.cover = cover;
  text.material =
      fmt::format(R"("density": 2300, "model": "{}", "young_modulus": 1e9, "poisson_ratio": 0.25)", material);
  text.material +=
      std::string_view(material) == "mohr_coulomb" ? R"(, "friction_angle": 30, "cohesion": 1e5)" : "";
  if (std::string_view(cover) == "block") text.material += R"(, "damping_time": 1e-4)";
  text.interface = fmt::format(R"("normal_stiffness": 1e9, "tangential_stiffness": 1e9, "friction_angle": 20,
                                  "normal_damping": {0}, "tangential_damping": {0})",
                               damping);
  const Ends without = ends_of(text, "");
  const Ends with = ends_of(text, R"("stages": [{"name": "a", "from": 0.0005, "set": {"/gravity": [0, -10]}},
                                  {"name": "b", "from": 0.00123, "set": {"/gravity": [0, -10]}}],)");
  REQUIRE(without.lost > 0);
  CHECK(with.position == Approx(without.position).epsilon(1e-9));
  CHECK(with.velocity == Approx(without.velocity).epsilon(1e-9));
  CHECK(with.lost == Approx(without.lost).epsilon(1e-9));
  CHECK(with.residual <= without.residual + 1e-4);
}

TEST_CASE("what global damping takes is known where steps are uneven", "[simulation][stages]") {
  const std::string cover = GENERATE("rigid", "block", "hexagonal");
  CAPTURE(cover);
  WorkingScene text;
  text.cover = cover == "hexagonal" ? "block" : cover;
  text.gravity = "[5, -3]";
  text.bodies =
      box("a", 0, 0, 2, 1,
          cover == "hexagonal" ? R"("surfaces": {"left": [3]}, "cover": {"model": "hexagonal", "size": 0.45})"
                               : R"("surfaces": {"left": [3]})");
  text.rest =
      R"("prescribed": [{"body": "a", "surface": "left", "stiffness": 1e9, "displacement": [1e-3, 0]}],
                 "stages": [{"name": "damped", "from": 0.01141, "set": {"/damping": 1000}}],)";
  text.time = R"({"end": 0.1, "dt": 1e-4})";
  text.output = R"({"history": 0.0005})";
  const Simulation simulation = run_to_end(text);
  CHECK(simulation.ledger().global_damping_loss > 1);
  CHECK(simulation.summary().largest_residual_share < 1e-3);
}

TEST_CASE("a stage under kinetic damping takes no velocity that grows", "[simulation][stages]") {
  for (const char* cover : {"rigid", "block"}) {
    WorkingScene text;
    text.cover = cover;
    text.gravity = "[0, -10]";
    text.bodies = box("a", 0, 0, 1, 1);
    text.rest = R"("damping": "kinetic",
                   "stages": [{"name": "heavy", "from": 0.1, "set": {"/gravity": [0, -20]}}],)";
    text.time = R"({"end": 0.2, "dt": 1e-3})";
    CHECK(run_to_end(text).body_motion(0).velocity.y == Approx(-3).epsilon(1e-9));
  }
}

TEST_CASE("the first step of a stage is bounded by the velocities that it begins with",
          "[simulation][stages]") {
  WorkingScene text;
  text.bodies = box("wall", 2, -1, 3, 2, R"("fixed": true)") + ", " + box("a", 0, 0, 1, 1);
  text.interface = R"("normal_stiffness": 1e4, "normal_damping": 0, "tangential_stiffness": 0,
                      "friction_angle": 0, "tangential_damping": 0)";
  text.rest = R"("stages": [{"name": "pushed", "from": 0.5, "set": {"/bodies/1/drive": {"x": 40}}}],)";
  text.time = R"({"end": 1})";
  text.output = R"({"history": 0.1})";
  CHECK_THROWS_WITH(run_to_end(text), Catch::Contains("too deep an overlap"));
}

TEST_CASE("a body that is held under its weight and then let go keeps its balance", "[simulation][stages]") {
  WorkingScene text;
  text.gravity = "[0, -10]";
  text.bodies =
      box("a", -1, 0, 1, 1, R"("fix": ["x", "y", "rotation"], "cover": {"model": "hexagonal", "size": 0.5})");
  text.rest = R"("stages": [{"name": "free", "from": 0.1, "set": {"/bodies/0/fix": []}}],)";
  text.time = R"({"end": 0.3})";
  const Scene scene = text.read();
  Simulation simulation(scene, {});
  while (simulation.advance()) {
  }
  CHECK(simulation.body_motion(0).displacement.y == Approx(-5 * 0.2 * 0.2).epsilon(1e-6));
  CHECK(simulation.summary().largest_residual_share <= 1e-6);
}

TEST_CASE("a support that a stage begins takes or gives the kinetic energy, whatever the steps are",
          "[simulation][stages]") {
  const auto cover = GENERATE(R"({"model": "rigid"})", R"({"model": "hexagonal", "size": 0.5})");
  // Just after an output, on one, and just before one: what is left of the interval is one step.
  const auto from = GENERATE(0.400, 0.402, 0.404);
  const auto [begins_with, set, work] = GENERATE(table<const char*, const char*, double>(
      {{"[0, 0]", R"("/bodies/0/drive": {"y": 2})", 4600}, {"[0, 2]", R"("/bodies/0/fix": ["y"])", -4600}}));
  WorkingScene text;
  text.bodies = box("a", 0, 0, 1, 1, fmt::format(R"("velocity": {}, "cover": {})", begins_with, cover));
  text.rest = fmt::format(R"("stages": [{{"name": "begin", "from": {}, "set": {{{}}}}}],)", from, set);
  text.time = R"({"end": 0.6})";
  text.output = R"({"history": 0.006})";
  const Simulation simulation = run_to_end(text);
  CAPTURE(cover, from, set);
  CHECK(simulation.ledger().external_work == Approx(work).epsilon(1e-9));
  CHECK(simulation.summary().largest_residual_share <= 1e-6);
}

TEST_CASE("a support that moves on through a stage keeps its books", "[simulation][stages]") {
  // A block is pulled along by springs; the stage changes nothing, or the springs.
  const auto cover = GENERATE(R"({"model": "rigid"})", R"({"model": "hexagonal", "size": 0.5})");
  const auto set = GENERATE(
      R"("/gravity": [0, 0])",
      R"("/prescribed": [{"body": "a", "surface": "foot", "stiffness": 4e6, "velocity": [1, null]}])",
      R"("/prescribed": [])");
  WorkingScene text;
  text.bodies = box("a", 0, 0, 1, 1, fmt::format(R"("surfaces": {{"foot": [0]}}, "cover": {})", cover));
  text.rest = fmt::format(
      R"("prescribed": [{{"body": "a", "surface": "foot", "stiffness": 1e6, "velocity": [1, null]}}],
         "stages": [{{"name": "next", "from": 0.02, "set": {{{}}}}}],)",
      set);
  text.time = R"({"end": 0.1})";
  text.output = R"({"history": 0.002})";
  CAPTURE(cover, set);
  CHECK(run_to_end(text).summary().largest_residual_share <= 1e-5);
}

TEST_CASE("ground that moves ever faster works on a free body by the mean of both ends of a step",
          "[simulation][stages]") {
  for (const char* cover :
       {R"({"model": "rigid"})", R"({"model": "block"})", R"({"model": "hexagonal", "size": 0.5})"}) {
    WorkingScene text;
    text.bodies = box("a", 0, 0, 1, 1, std::string(R"("cover": )") + cover);
    text.rest = R"("base_acceleration": [{"scale": -9, "time": [[0, 0], [5, 1]]}, 0],)";
    text.time = R"({"end": 1, "dt": 1e-5})";
    const Scene scene = text.read();
    Simulation simulation(scene, {});
    while (simulation.advance()) {
    }
    CHECK(simulation.body_motion(0).velocity.x == Approx(0.9).epsilon(1e-4));
    CHECK(simulation.summary().largest_residual_share <= 1e-6);
  }
}

TEST_CASE("a stage a rounding before an output begins with it", "[simulation][stages]") {
  const auto run = [](const char* from) {
    WorkingScene text = resting_block();
    text.time = R"({"end": 0.4})";
    text.output = R"({"history": 0.1})";
    text.rest =
        fmt::format(R"("stages": [{{"name": "same", "from": {}, "set": {{"/gravity": [0, -10]}}}}],)", from);
    return run_to_end(text);
  };
  // 3 · 0.1 is the next double after 0.3.
  const Simulation before = run("0.3"), at = run("0.30000000000000004");
  CHECK(before.summary().steps == at.summary().steps);
  CHECK(before.state_hash() == at.state_hash());
}

TEST_CASE("of stages that begin at once the last holds, and energy is booked from before the first",
          "[simulation][stages]") {
  WorkingScene text = resting_block();
  text.time = R"({"end": 0.1})";
  text.rest = R"("settle": {"duration": 0.3, "damping": 300},
                 "stages": [{"name": "soft", "from": 0.05, "set": {"/interfaces/0/normal_stiffness": 4e9}},
                            {"name": "softer", "from": 0.05000000001, "set": {"/interfaces/0/normal_stiffness": 8e9}}],)";
  const Simulation both = [&] {
    Simulation simulation(text.read(), {});
    simulation.settle();
    while (simulation.advance()) {
    }
    return simulation;
  }();
  CHECK(both.ledger().residual / both.ledger().throughput == Approx(0).margin(0.02));
}

TEST_CASE("a body that was turned inside out stops the run, however it is covered", "[simulation][trouble]") {
  for (const char* cover : {R"({"model": "block"})", R"({"model": "hexagonal", "size": 0.5})"}) {
    INFO(cover);
    WorkingScene text = resting_block();
    text.bodies = box("base", -1, -1, 3, 0, R"("fixed": true)") + ", " +
                  box("a", 0, 0, 2, 1, R"("cover": )" + std::string(cover));
    text.material =
        R"("density": 2300, "model": "linear_elastic", "young_modulus": 5, "poisson_ratio": 0.25)";
    text.rest = R"("limits": {"penetration": 100, "energy_residual": 1e9},)";
    text.time = R"({"end": 2})";
    CHECK_THROWS_WITH(run_to_end(text), Catch::Contains("inside out") && Catch::Contains("young_modulus"));
  }
}

TEST_CASE("a stage that changes nothing does no work on bodies that meet as it begins",
          "[simulation][stages]") {
  for (const char* law : {"overlap_area", "frictionless", "vertex_edge"}) {
    CAPTURE(law);
    WorkingScene text;
    text.cover = "rigid";
    text.law = law;
    text.interface = R"("normal_stiffness": 1e10, "normal_damping": 0)";
    if (text.law != "frictionless")
      text.interface += R"(, "tangential_stiffness": 1e10, "friction_angle": 30, "tangential_damping": 0)";
    text.bodies = box("base", -1, -1, 2, 0, R"("fixed": true)") + ", " +
                  box("a", 0, 0.00105, 1, 1.00105, R"("velocity": [0, -1])");
    text.rest = R"("stages": [{"name": "same", "from": 0.0011, "set": {"/gravity": [0, 0]}}],)";
    text.time = R"({"end": 0.0013, "dt": 1e-4})";
    text.output = R"({"history": 1e-4})";
    Simulation simulation(text.read(), {});
    while (simulation.advance()) {
    }
    REQUIRE(simulation.ledger().contact > 10);
    CHECK(simulation.ledger().external_work == 0);
  }
}

TEST_CASE("bonds that get their strength in a stage are known from the start", "[simulation][stages]") {
  // Contacts are born bonded: what such a bond may span must not be sifted out, nor other geometry be given.
  WorkingScene text = resting_block();
  text.law = "vertex_edge";
  CHECK_FALSE(may_bond(text.read()));
  text.rest += R"("stages": [{"name": "warm", "from": 0.02, "set": {"/interfaces/0/friction_angle": 20}},
                             {"name": "grout", "from": 0.05, "set": {"/interfaces/0/cohesion": 2e6}}],)";
  CHECK(may_bond(text.read()));
}
