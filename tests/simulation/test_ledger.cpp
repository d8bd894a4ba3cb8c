#include "simulation/simulation.hpp"
#include "working_scene.hpp"

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <cmath>
#include <string>
#include <utility>

using namespace talus;

namespace {

/// A body in space, at rest until a force sets in at 0.01 s, damped as a whole.
WorkingScene pushed(const std::string& cover) {
  WorkingScene text;
  text.bodies = box("a", 0, 0, 2, 1, R"("cover": )" + cover);
  text.rest = R"("damping": 200, "loads": [{"body": "a", "point": [2, 1],
                 "force": [{"scale": 3000, "time": [[0.01, 0], [0.010001, 1], [0.02, 1]]},
                           {"scale": -2000, "time": [[0.01, 0], [0.013, 1]]}]}],)";
  text.time = R"({"end": 0.03, "dt": 1e-4})";
  text.output = R"({"history": 1e-4})";
  return text;
}

}  // namespace

TEST_CASE("the balance holds from the first step of a motion that starts under damping",
          "[simulation][ledger]") {
  for (const char* cover :
       {R"({"model": "rigid"})", R"({"model": "block"})", R"({"model": "hexagonal", "size": 0.5})"}) {
    INFO(cover);
    WorkingScene text = pushed(cover);
    Simulation simulation(text.read(), {});
    bool moved = false;
    while (simulation.advance()) {
      const EnergyLedger& ledger = simulation.ledger();
      moved = moved || ledger.kinetic > 0;
      CHECK(std::abs(ledger.residual) <= 1e-7 * ledger.throughput);
    }
    CHECK(moved);
    CHECK(simulation.ledger().global_damping_loss > 0);
  }
}

TEST_CASE("the balance holds where the stiffness changes at a corner of many elements",
          "[simulation][ledger][contact]") {
  // Its lower side has a third of the stiffness of the others. What the pressure jumps by between the two is
  // the wedge's, whichever body comes first, and of whichever a floor of many elements makes the master.
  const auto dropped = [](const std::string& floor, bool floor_first) {
    WorkingScene text;
    text.law = "frictionless";
    const std::string wedge = R"({"name": "wedge", "material": "rock", "surfaces": {"base": [0]},
        "polygon": [[0, 0.0002], [1, 0.3], [0.6, 0.9]], "cover": {"model": "hexagonal", "size": 0.2},
        "velocity": [0, -1], "fix": ["x", "rotation"]})";
    const std::string ground =
        R"({"name": "floor", "material": "rock", "polygon": [[-2, -1], [2, -1], [2, 0], [-2, 0]], )" + floor +
        "}";
    text.bodies = floor_first ? ground + ", " + wedge : wedge + ", " + ground;
    text.material =
        R"("density": 2000, "model": "linear_elastic", "young_modulus": 1e9, "poisson_ratio": 0.2)";
    text.interface = R"("normal_stiffness": 3e9, "normal_damping": 0},
                       {"between": ["base", "rock"], "normal_stiffness": 1e9, "normal_damping": 0)";
    text.time = R"({"end": 0.02})";
    return run_to_end(text).summary().largest_residual_share;
  };
  const std::string rigid = R"("cover": {"model": "rigid"}, "fix": ["x", "y", "rotation"])",
                    many = R"("cover": {"model": "hexagonal", "size": 0.5}, "fix": ["x", "y", "rotation"])";
  CHECK(dropped(R"("fixed": true)", true) < 1e-3);
  for (const std::string& floor : {rigid, many}) {
    for (const bool first : {true, false}) {
      INFO(floor << ", first " << first);
      CHECK(dropped(floor, first) < 1e-3);
    }
  }
}

TEST_CASE("the balance of a viscous body under a sudden load closes", "[simulation][ledger]") {
  // At the automatic step the fastest modes of a lattice turn over with each step, and what viscous stress
  // does in the half step ahead has the other sign.
  const char *short_step = R"(, "dt": 8e-6)", *automatic = "", *block = R"({"model": "block"})",
             *many = R"({"model": "hexagonal", "size": 0.5})",
             *fine = R"({"model": "hexagonal", "size": 0.21, "angle": 48.9, "slivers": "keep"})";
  for (const char* model : {"linear_elastic", "hypoelastic", "mohr_coulomb"}) {
    for (const auto& [cover, dt] :
         {std::pair{block, short_step}, {many, short_step}, {block, automatic}, {fine, automatic}}) {
      INFO(model << ", " << cover << dt);
      WorkingScene text;
      text.material = fmt::format(
          R"("density": 2300, "model": "{}", "young_modulus": 1e10, "poisson_ratio": 0.25, "damping_time": 1e-4)",
          model);
      if (model == std::string("mohr_coulomb")) text.material += R"(, "friction_angle": 30, "cohesion": 1e7)";
      text.bodies = box("a", 0, 0, 1, 1, R"("cover": )" + std::string(cover));
      text.rest =
          R"("loads": [{"body": "a", "point": [1, 1], "force": [{"scale": 1e6, "time": [[0, 1], [2e-5, 0]]}, 0]}],)";
      text.time = fmt::format(R"({{"end": 0.005{}}})", dt);
      const Simulation simulation = run_to_end(text);
      CHECK(simulation.ledger().material_loss > 0);
      CHECK(simulation.summary().largest_residual_share < 1e-7);
    }
  }
}

TEST_CASE("a trace of viscosity leaves the balance of a plastic body as it is", "[simulation][ledger]") {
  const auto largest_share = [](double damping_time) {
    WorkingScene text;
    text.material = fmt::format(
        R"("density": 2300, "model": "mohr_coulomb", "young_modulus": 1e9, "poisson_ratio": 0.25,
           "friction_angle": 20, "cohesion": 1e4, "damping_time": {})",
        damping_time);
    text.bodies =
        box("base", -2, -1, 2, 0, R"("fixed": true)") + "," +
        box("a", 0, 0, 1, 1, R"("cover": {"model": "hexagonal", "size": 0.5}, "velocity": [0, -2])");
    text.time = R"({"end": 0.02, "dt": 1e-5})";
    const Simulation simulation = run_to_end(text);
    CHECK(simulation.ledger().material_loss > 0);
    return simulation.summary().largest_residual_share;
  };
  CHECK(largest_share(1e-12) == Approx(largest_share(0)).epsilon(1e-3));
}

TEST_CASE("dashpots that push from the start on are booked from the start on", "[simulation][ledger]") {
  for (const char* law : {"overlap_area", "vertex_edge"}) {
    INFO(law);
    WorkingScene text;
    text.law = law;
    text.interface = R"("normal_stiffness": 1e8, "tangential_stiffness": 1e8, "friction_angle": 45,
                        "normal_damping": 0.3, "tangential_damping": 0.3)";
    text.bodies = box("floor", -1, -1, 2, 0, R"("fixed": true)") + "," +
                  box("a", 0, 0, 1, 1, R"("velocity": [0.02, -0.02], "fix": ["rotation"])");
    text.gravity = "[0, -10]";
    text.rest = R"("settle": {"duration": 1, "damping": "adaptive"},)";
    text.time = R"({"end": 2e-4, "dt": 1e-4})";
    Simulation simulation(text.read(), {});
    REQUIRE(simulation.settle());
    while (simulation.advance()) {
    }
    CHECK(simulation.ledger().contact_damping_loss > 0);
    CHECK(std::abs(simulation.ledger().residual) < 1e-3 * simulation.ledger().contact_damping_loss);
  }
}

TEST_CASE("what a dashpot pushed with until its contact slips is booked", "[simulation][ledger]") {
  // At t = 0 dashpots bear all of the friction, one step later the contact slips.
  for (const char* law : {"overlap_area", "cohesive_overlap", "vertex_edge"}) {
    INFO(law);
    WorkingScene text;
    text.law = law;
    text.interface = R"("normal_stiffness": 1e8, "tangential_stiffness": 1e8, "friction_angle": 20,
                        "normal_damping": 0.3, "tangential_damping": 0.3)";
    text.bodies = box("floor", -5, -1, 5, 0, R"("fixed": true)") + "," +
                  box("a", 0, 0, 2, 0.5, R"("velocity": [0.06, 0])");
    text.gravity = "[0, -9.81]";
    text.rest = R"("settle": {"duration": 0.3, "damping": 200},)";
    text.time = R"({"end": 0.05, "dt": 6e-4})";
    Simulation simulation(text.read(), {});
    REQUIRE(simulation.settle());
    while (simulation.advance()) {
    }
    CHECK(simulation.ledger().friction_loss > 0);
    CHECK(simulation.summary().largest_residual_share < 5e-3);
  }
}

TEST_CASE("what is missed while a scene settles is told, and a small step is not blamed",
          "[simulation][ledger]") {
  WorkingScene text;
  text.bodies = box("floor", -1, -1, 2, 0, R"("fixed": true)") + "," + box("a", 0, 0, 1, 1);
  text.gravity = "[0, -10]";
  text.rest = R"("settle": {"duration": 0.01, "damping": 10}, "limits": {"energy_residual": 1e-15},)";
  text.time = R"({"end": 0.01, "dt": 1e-6})";
  Simulation simulation(text.read(), {});
  REQUIRE(simulation.settle());
  REQUIRE(simulation.summary().warnings.size() == 1);
  CHECK_THAT(simulation.summary().warnings[0], Catch::Contains("while the scene settled the energy balance"));
  const auto run = [&] {
    while (simulation.advance()) {
    }
  };
  CHECK_THROWS_WITH(run(), Catch::Contains("hardly the step; `talus check-plugin`"));
}

TEST_CASE("a balance that dashpots lose is not to be mended by more of them", "[simulation][ledger]") {
  const auto trouble = [](const std::string& damping, const std::string& dt) {
    WorkingScene text;
    text.interface = R"("normal_stiffness": 1e8, "tangential_stiffness": 1e8, "friction_angle": 30,
                        "tangential_damping": 0, "normal_damping": )" +
                     damping;
    text.bodies = box("floor", -1, -1, 3, 0, R"("fixed": true)") +
                  R"(, {"name": "plate", "material": "rock", "velocity": [0, -0.1],
                        "polygon": [[0, 1e-4], [2, 5e-4], [2, 0.2005], [0, 0.2001]]})";
    text.gravity = "[0, -10]";
    text.rest = R"("limits": {"energy_residual": 1e-5},)";
    text.time = R"({"end": 0.05, "dt": )" + dt + "}";
    text.output = R"({"history": 0.01})";
    std::string words;
    try {
      run_to_end(text);
    } catch (const NumericalTrouble& caught) {
      words = caught.what();
    }
    return words;
  };
  CHECK_THAT(trouble("5", "1e-4"), Catch::Contains("or less normal_damping"));
  CHECK_THAT(trouble("0", "1e-3"), Catch::Contains("or damp the contacts"));
}

TEST_CASE("what rounding makes of a wall at rest far from the origin is nothing to warn of",
          "[simulation][ledger]") {
  WorkingScene text;
  text.cover = "block";
  const Vec2 right{std::cos(0.576), std::sin(0.576)}, up{-right.y, right.x};
  const auto brick = [&](const std::string& name, double left, double bottom, double right_end, double top) {
    const auto corner = [&](double x, double y) {
      return fmt::format("[{}, {}]", 1000 + x * right.x + y * up.x, 2000 + x * right.y + y * up.y);
    };
    return fmt::format(R"({{"name": "{}", "material": "rock", "polygon": [{}, {}, {}, {}])", name,
                       corner(left, bottom), corner(right_end, bottom), corner(right_end, top),
                       corner(left, top));
  };
  text.bodies = brick("floor", -1, -1, 6, 0) + R"(, "fixed": true})";
  for (int row = 0; row < 4; ++row) {
    for (int i = 0; i < 4; ++i) {
      const double left = i + 0.5 * (row % 2), bottom = 0.5 * row;
      text.bodies += ", " + brick(fmt::format("b{}{}", row, i), left, bottom, left + 1, bottom + 0.5) + "}";
    }
  }
  text.time = R"({"end": 0.1})";
  text.output = R"({"history": 0.001})";
  Simulation simulation(text.read(), {});
  while (simulation.advance()) {
  }
  CHECK(simulation.ledger().throughput > 0);  // corners are rounded
  CHECK(simulation.summary().warnings.empty());
}

TEST_CASE("the largest overlap of a run that is stopped is that which stopped it", "[simulation]") {
  WorkingScene text;
  text.interface = R"("normal_stiffness": 1e5, "tangential_stiffness": 1e5, "friction_angle": 30,
                      "normal_damping": 0, "tangential_damping": 0)";
  text.bodies = box("floor", -1, -1, 2, 0, R"("fixed": true)") + "," +
                box("a", 0, 0.1, 1, 1.1, R"("velocity": [0, -20])");
  text.time = R"({"end": 1, "dt": 1e-3})";
  Simulation simulation(text.read(), {});
  const auto run = [&] {
    while (simulation.advance()) {
    }
  };
  CHECK_THROWS_WITH(run(), Catch::Contains("too deep an overlap"));
  CHECK(simulation.summary().largest_penetration > 0.3);
}

TEST_CASE("steps of another length from a stage to the next output leave the balance as it is",
          "[simulation][ledger]") {
  for (const char* cover : {"rigid", "block"}) {
    INFO(cover);
    WorkingScene text;
    text.cover = cover;
    text.material =
        R"("density": 2500, "model": "linear_elastic", "young_modulus": 1e7, "poisson_ratio": 0.25)";
    text.bodies = box("held", 0, 30, 1, 32, R"("fix": ["x", "y", "rotation"])") + "," +
                  box("floor", -5, -1, 5, 0, R"("fixed": true)");
    text.gravity = "[0, -9.81]";
    text.rest = R"("stages": [{"name": "let go", "from": 0.1205, "set": {"/bodies/0/fix": []}}],)";
    text.output = R"({"history": 1e-3})";
    text.time = R"({"end": 0.2, "dt": 1e-3})";
    CHECK(run_to_end(text).summary().largest_residual_share < 1e-9);

    // Nor do those that change nothing, while it falls.
    text.bodies = box("falls", 0, 30, 1, 32) + "," + box("floor", -5, -1, 5, 0, R"("fixed": true)");
    text.rest = R"("stages": [{"name": "one", "from": 0.0305, "set": {"/gravity": [0, -9.81]}},
                              {"name": "two", "from": 0.0707, "set": {"/gravity": [0, -9.81]}},
                              {"name": "three", "from": 0.0709, "set": {"/gravity": [0, -9.81]}}],)";
    CHECK(run_to_end(text).summary().largest_residual_share < 1e-9);
  }
}
