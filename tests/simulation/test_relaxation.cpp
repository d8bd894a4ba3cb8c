#include "simulation/simulation.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <cmath>

using namespace talus;

namespace {

/// A body of one cover on a fixed table, under its weight.
WorkingScene resting(const std::string& cover, const std::string& damping) {
  WorkingScene text;
  text.gravity = "[0, -10]";
  text.bodies =
      box("table", -3, -1, 3, 0, R"("fixed": true)") + ", " + box("a", -1, 0, 1, 1, R"("cover": )" + cover);
  text.rest = fmt::format(R"("settle": {{"duration": 5, "damping": "{}", "until": 1e-6}},)", damping);
  text.time = R"({"end": 0.01})";
  return text;
}

}  // namespace

TEST_CASE("relaxation finds the weight on the table and ends when forces balance",
          "[simulation][relaxation]") {
  for (const char* cover :
       {R"({"model": "rigid"})", R"({"model": "block"})", R"({"model": "hexagonal", "size": 0.5})"}) {
    for (const char* damping : {"adaptive", "kinetic"}) {
      INFO(cover << ' ' << damping);
      const Scene scene = resting(cover, damping).read();
      Simulation simulation(scene, {});
      simulation.settle();
      simulation.advance();
      double carried = 0;
      for (const Contact& contact : simulation.contacts()) carried += contact.normal_force.y;
      CHECK(carried == Approx(2300 * 2 * 10).epsilon(1e-4));
      const double nominal = 5 / simulation.critical_dt();
      CHECK(static_cast<double>(simulation.summary().settle_steps) < nominal);  // it ended early
      while (simulation.advance()) {
      }
      CHECK(simulation.body_motion(1).displacement.y == Approx(0).margin(1e-9));
    }
  }
}

TEST_CASE("kinetic damping stops what is free and leaves what is driven its way",
          "[simulation][relaxation]") {
  for (const char* cover : {"rigid", "block"}) {
    for (const char* driven : {"", R"(, "cover": {"model": "hexagonal", "size": 0.5})"}) {
      INFO(cover << driven);
      WorkingScene text;
      text.cover = cover;
      text.gravity = "[0, -10]";
      text.bodies =
          box("table", 3, -1, 6, 0, R"("fixed": true)") + ", " +
          box("d", -1, 0, 0, 1, R"("drive": {"x": 1, "y": 0, "rotation": 0})" + std::string(driven)) + ", " +
          box("a", 4, 0.01, 5, 1);
      text.interface = R"("normal_stiffness": 1e8, "tangential_stiffness": 1e8, "friction_angle": 30,
                          "normal_damping": 0, "tangential_damping": 0)";
      text.rest = R"("damping": "kinetic",)";
      text.time = R"({"end": 0.5})";
      const Simulation simulation = run_to_end(text);
      CHECK(simulation.body_motion(1).displacement.x == Approx(0.5).epsilon(1e-9));
      CHECK(std::abs(simulation.body_motion(2).velocity.y) < 0.02);  // free, it would bounce with 0.4 m/s
      CHECK(residual_share(simulation.ledger()) < 2e-3);
    }
  }
}

TEST_CASE("kinetic damping only takes energy, also of what rings at the automatic step",
          "[simulation][relaxation]") {
  for (const char* cover :
       {R"({"model": "rigid"})", R"({"model": "block"})", R"({"model": "hexagonal", "size": 0.5})"}) {
    for (const double damping_ratio : {0.0, 0.3}) {
      INFO(cover << damping_ratio);
      WorkingScene text = resting(cover, "kinetic");
      text.rest = R"("damping": "kinetic",)";
      text.time = R"({"end": 0.1})";
      text.interface = fmt::format(R"("normal_stiffness": 1e9, "tangential_stiffness": 1e9,
          "friction_angle": 30, "normal_damping": {0}, "tangential_damping": {0})",
                                   damping_ratio);
      Simulation simulation(text.read(), {});
      double taken = 0, initial = 0;
      while (simulation.advance()) {
        const EnergyLedger& now = simulation.ledger();
        CHECK(now.global_damping_loss >= taken);
        taken = now.global_damping_loss;
        initial = std::max(initial, now.throughput);
      }
      CHECK(taken > 0.1 * initial);
      CHECK(residual_share(simulation.ledger()) < 1e-3);
      CHECK(std::abs(simulation.body_motion(1).velocity.y) < 1e-6);
    }
  }
}

TEST_CASE("what a settle stage saw of energy and forces says nothing of what comes",
          "[simulation][relaxation]") {
  for (const char* damping : {R"("kinetic")", R"("adaptive")"}) {
    INFO(damping);
    WorkingScene text;
    text.gravity = "[0, -10]";
    text.bodies = box("table", -3, -1, 9, 0, R"("fixed": true)") + ", " + box("a", 0, 5, 1, 6) + ", " +
                  box("b", 3, 5, 4, 6, R"("velocity": [0.001, 0])");
    text.rest = fmt::format(R"("settle": {{"duration": 0.01, "damping": {0}}}, "damping": {0},)", damping);
    text.time = R"({"end": 0.001, "dt": 1e-5})";
    Simulation simulation(text.read(), {});
    simulation.settle();
    REQUIRE(simulation.summary().settle_steps > 0);
    while (simulation.advance()) {
    }
    CHECK(simulation.body_motion(2).displacement.x == Approx(1e-6).epsilon(1e-9));
  }
}

TEST_CASE("what a support carries is not out of balance", "[simulation][relaxation]") {
  for (const char* cover :
       {R"({"model": "rigid"})", R"({"model": "block"})", R"({"model": "hexagonal", "size": 0.5})"}) {
    INFO(cover);
    WorkingScene text = resting(cover, "adaptive");
    text.bodies = box("table", -3, -1, 3, 0, R"("fix": ["x", "y", "rotation"])") + ", " +
                  box("a", -1, 0, 1, 1, R"("cover": )" + std::string(cover));
    Simulation simulation(text.read(), {});
    simulation.settle();
    CHECK(static_cast<double>(simulation.summary().settle_steps) < 2.5 / simulation.critical_dt());
  }
}

TEST_CASE("what penalty supports push against each other is no load that a scene settles by",
          "[simulation][relaxation]") {
  WorkingScene text;
  text.gravity = "[0, -10]";
  text.bodies =
      box("beam", 0, 0, 4, 1, R"("cover": {"model": "hexagonal", "size": 0.5}, "surfaces": {"wall": [3]})");
  text.rest =
      R"("prescribed": [{"body": "beam", "surface": "wall", "stiffness": 1e9, "displacement": [0, 0]}],
                 "settle": {"duration": 3, "damping": "adaptive", "until": 0.01},)";
  text.monitors = R"({"name": "beam", "body": "beam", "point": [4, 0.5]})";
  const auto tip_after = [&](const char* until) {
    WorkingScene settled = text;
    settled.rest.replace(settled.rest.find("0.01"), 4, until);
    Simulation simulation(settled.read(), {});
    simulation.settle();
    CHECK(simulation.summary().settle_steps > 100);
    return simulation.monitor_motion(0).position.y - 0.5;
  };
  const double sag = tip_after("1e-6");
  CHECK(sag < 0);
  CHECK(tip_after("0.01") == Approx(sag).epsilon(0.02));
}

TEST_CASE("settling goes on however often it is left off", "[simulation][settle]") {
  WorkingScene text = resting(R"({"model": "rigid"})", "adaptive");
  text.rest = R"("settle": {"duration": 0.01, "damping": 10},)";
  Simulation whole(text.read(), {}), often(text.read(), {});
  whole.settle();
  int calls = 1;
  while (!often.settle([] { return true; })) REQUIRE(++calls < 100000);
  CHECK(often.state_hash() == whole.state_hash());
}

TEST_CASE("a body that falls while it settles is told of, one that sinks into place is not",
          "[simulation][settle]") {
  for (const auto& [height, told] : {std::pair{0.3, true}, {0.0, false}}) {
    WorkingScene text = resting(R"({"model": "block"})", "adaptive");
    text.bodies += ", " + box("b", 1.5, height, 2.5, 1 + height);
    Simulation simulation(text.read(), {});
    simulation.settle();
    const std::vector<std::string> warnings = simulation.summary().warnings;
    REQUIRE(warnings.size() == (told ? 1 : 0));
    if (told)
      CHECK_THAT(warnings[0], Catch::Contains("a body moved by more than 0.1 of its width, 'b' at") &&
                                  Catch::Contains("by 0.3 m: displacements count from there"));
  }
}

TEST_CASE("kinetic damping leaves the books of dashpots right", "[simulation][relaxation]") {
  for (const char* cover : {"rigid", "block"}) {
    for (const char* law : {"overlap_area", "vertex_edge"}) {
      for (const double damping_ratio : {0.3, 1.0}) {
        INFO(cover << ' ' << law << ' ' << damping_ratio);
        WorkingScene text;
        text.cover = cover;
        text.law = law;
        text.gravity = "[0, -10]";
        text.bodies = box("table", -3, -1, 3, 0, R"("fixed": true)") + ", " + box("a", 0, 0.5, 2, 1.5);
        text.interface = fmt::format(R"("normal_stiffness": 1e8, "tangential_stiffness": 1e8,
            "friction_angle": 30, "normal_damping": {0}, "tangential_damping": {0})",
                                     damping_ratio);
        text.rest = R"("damping": "kinetic",)";
        text.time = R"({"end": 0.6})";
        const Simulation simulation = run_to_end(text);
        CHECK(simulation.ledger().contact_damping_loss > 0.02 * simulation.ledger().throughput);
        CHECK(residual_share(simulation.ledger()) < 3e-3);
      }
    }
  }
}

TEST_CASE("what is viscous is no stiffness to adaptive damping, and is booked from the first step on",
          "[simulation][relaxation]") {
  for (const char* damping : {R"("adaptive")", "0"}) {
    for (const double damping_time : {0.003, 0.1}) {
      INFO(damping << ", " << damping_time << " s");
      WorkingScene text;
      text.cover = "block";
      text.material = fmt::format(R"("density": 2000, "model": "linear_elastic", "young_modulus": 1e8,
          "poisson_ratio": 0.3, "damping_time": {})",
                                  damping_time);
      text.bodies = box("a", 0, 0, 1, 1, R"("surfaces": {"bottom": [0], "top": [2]})");
      text.rest = fmt::format(R"("damping": {},
          "surface_loads": [{{"body": "a", "surface": "top", "traction": [0, -2e4]}}],
          "prescribed": [{{"body": "a", "surface": "bottom", "stiffness": 1e10, "displacement": [0, 0]}}],)",
                              damping);
      text.time = R"({"end": 0.005})";
      Simulation simulation(text.read(), {});
      while (simulation.advance()) {
        const EnergyLedger& ledger = simulation.ledger();
        REQUIRE(std::abs(ledger.residual) <= 3e-3 * ledger.throughput);
      }
    }
  }
}

TEST_CASE("friction that lets go where kinetic damping takes velocities is booked",
          "[simulation][relaxation]") {
  // Without the dashpot, at rest, the block bears less friction than it had a moment before.
  for (const char* law : {"overlap_area", "vertex_edge"}) {
    INFO(law);
    WorkingScene text;
    text.law = law;
    text.gravity = "[0, -10]";
    text.bodies = box("table", -3, -1, 3, 0, R"("fixed": true)") + ", " + box("a", 0, 0, 1, 1);
    text.interface = R"("normal_stiffness": 1e8, "tangential_stiffness": 1e8, "friction_angle": 30,
                        "normal_damping": 2, "tangential_damping": 0)";
    text.rest =
        R"("damping": "kinetic", "loads": [{"body": "a", "point": [0.5, 0.5], "force": [11500, 0]}],)";
    text.time = R"({"end": 0.1})";
    CHECK(residual_share(run_to_end(text).ledger()) < 0.012);
  }
}
