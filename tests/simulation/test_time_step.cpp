#include "parallel/alone.hpp"
#include "simulation/simulation.hpp"
#include "simulation/time_step.hpp"
#include "stiffest_mode.hpp"
#include "working_scene.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

using namespace talus;

namespace {

CriticalStep vote_of(const Scene& scene) {
  const Model model = build_model(scene);
  return StepVote(scene, settings_of(scene), model, ContactStage(scene, model, alone(), true)).anyhow();
}

std::string stiff(double normal, double tangential) {
  return fmt::format(R"("normal_stiffness": {}, "tangential_stiffness": {}, "friction_angle": 30,
                         "normal_damping": 0, "tangential_damping": 0)",
                     normal, tangential);
}

/// A block of 1 x 1 m with a neighbour on every side.
WorkingScene cross(double stiffness, const std::string& cover, const std::string& neighbours) {
  WorkingScene scene;
  scene.cover = cover;
  scene.bodies = box("middle", 0, 0, 1, 1) + ", " + box("east", 1, 0, 2, 1, neighbours) + ", " +
                 box("north", 0, 1, 1, 2, neighbours) + ", " + box("west", -1, 0, 0, 1, neighbours) + ", " +
                 box("south", 0, -1, 1, 0, neighbours);
  scene.interface = stiff(stiffness, stiffness);
  return scene;
}

std::vector<Vec2> pressed(double depth) {
  return {{0, 0}, {-depth, 0}, {0, -depth}, {depth, 0}, {0, depth}};
}

struct Judged {
  double exact, voted;
  double ratio() const { return exact / voted; }
};

Judged judge(const WorkingScene& text, const std::vector<Vec2>& shift) {
  const Scene scene = text.read();
  return {2 / std::sqrt(stiffest_mode(scene, shift)), vote_of(scene).dt};
}

}  // namespace

TEST_CASE("without contacts the vote is the exact limit of the strain modes", "[simulation][time_step]") {
  // 1 x 1 block: mass of a strain mode ρ h⁴/12; the stiffest in plane strain is λ + 2G and λ together.
  WorkingScene text;
  text.cover = "block";
  text.bodies = box("a", 0, 0, 1, 1);
  const double along = 1e10 * 0.75 / (1.25 * 0.5), across = 1e10 * 0.25 / (1.25 * 0.5);
  const double omega = std::sqrt(12 * (along + across) / 2300);
  const CriticalStep vote = vote_of(text.read());
  CHECK(vote.dt == Approx(2 / omega).epsilon(1e-9));
  CHECK(vote.dt == Approx(2 / std::sqrt(stiffest_mode(text.read(), {{0, 0}}))).epsilon(1e-5));
  CHECK(limiter_of(text.read(), vote) == "body 'a': mostly its strain modes");
}

TEST_CASE("a rigid body that meets nobody has no limit", "[simulation][time_step]") {
  WorkingScene text;
  text.bodies = box("a", 0, 0, 1, 1);
  CHECK(std::isinf(vote_of(text.read()).dt));
}

TEST_CASE("a block among four neighbours: the vote is safe and within a factor of three",
          "[simulation][time_step]") {
  const std::string fixed = R"("fixed": true)";
  const Judged among_moving = judge(cross(1e11, "block", ""), pressed(1e-4));
  const Judged among_fixed = judge(cross(1e11, "block", fixed), pressed(1e-4));
  const Judged elastic = judge(cross(1e-3, "block", ""), pressed(1e-4));
  INFO("moving neighbours: true " << among_moving.exact << " s, vote " << among_moving.voted);
  INFO("fixed neighbours: true " << among_fixed.exact << " s, vote " << among_fixed.voted);
  INFO("elastic alone: true " << elastic.exact << " s");
  CHECK(elastic.exact == Approx(2.19e-4).epsilon(0.01));
  // Swelling evenly between fixed, smooth neighbours: ω² ρ h⁴/12 = (λ + 2G + λ) h² + α h³/2.
  WorkingScene smooth = cross(1e11, "block", fixed);
  smooth.interface = stiff(1e11, 0);
  const double swelling = std::sqrt((1.6e10 + 1e11 / 2) * 12 / 2300);
  CHECK(judge(smooth, pressed(1e-4)).exact == Approx(2 / swelling).epsilon(1e-3));
  CHECK(among_moving.ratio() >= 1);
  CHECK(among_moving.ratio() <= 3);
  CHECK(among_fixed.ratio() >= 1);
  CHECK(among_fixed.ratio() <= 3);
}

TEST_CASE("with heavy strain among four neighbours the vote is safe and within a factor of three",
          "[simulation][time_step][strain_mass]") {
  for (const double scale : {4.0, 100.0}) {
    WorkingScene text = cross(1e11, "block", "");
    text.bodies = "";
    for (const auto& [name, x, y] :
         {std::tuple{"middle", 0, 0}, std::tuple{"east", 1, 0}, std::tuple{"north", 0, 1},
          std::tuple{"west", -1, 0}, std::tuple{"south", 0, -1}})
      text.bodies += (text.bodies.empty() ? "" : ", ") +
                     box(name, x, y, x + 1, y + 1,
                         fmt::format(R"("cover": {{"model": "block", "strain_mass_scale": {}}})", scale));
    const Judged judged = judge(text, pressed(1e-4));
    INFO(scale << ": true " << judged.exact << " s, vote " << judged.voted);
    CHECK(judged.exact > judge(cross(1e11, "block", ""), pressed(1e-4)).exact);
    CHECK(judged.ratio() >= 1);
    CHECK(judged.ratio() <= 3);
  }
}

TEST_CASE("the vote is an upper bound of the frequency, whatever the bodies", "[simulation][time_step]") {
  for (const double stiffness : {1e9, 1e10, 1e12}) {
    for (const char* cover : {"block", "rigid"}) {
      INFO(cover << ", " << stiffness << " Pa/m");
      const Judged crossed = judge(cross(stiffness, cover, ""), pressed(1e-4));
      CHECK(crossed.ratio() >= 1 - 1e-6);
      CHECK(crossed.ratio() <= 3);

      // Three courses in running bond on a base.
      WorkingScene wall;
      wall.cover = cover;
      wall.interface = stiff(stiffness, stiffness);
      wall.bodies = box("base", -1, -1, 4, 0, R"("fixed": true)");
      std::vector<Vec2> shift{{0, 0}};
      for (int course = 0; course < 3; ++course) {
        for (int i = 0; i < 3; ++i) {
          const double left = i + 0.5 * (course % 2);
          wall.bodies +=
              ", " + box(fmt::format("c{}b{}", course, i), left, 0.5 * course, left + 1, 0.5 * (course + 1));
          shift.push_back({-i * 1e-4, -(course + 1) * 1e-4});
        }
      }
      CHECK(judge(wall, shift).ratio() >= 1 - 1e-6);

      // Masses as 1 to 1e6, one on the other.
      WorkingScene unequal;
      unequal.cover = cover;
      unequal.interface = stiff(stiffness, stiffness);
      unequal.bodies = box("large", 0, 0, 10, 10) + ", " + box("small", 5, 10, 5.01, 10.01);
      CHECK(judge(unequal, {{0, 0}, {0, -1e-5}}).ratio() >= 1 - 1e-6);
    }
  }
}

TEST_CASE("springs spread along a side resist rocking with a third of what those at its ends would",
          "[simulation][time_step]") {
  // A smooth rigid bar of 4 x 1 m on a base, which anybody may meet anywhere: with the springs of all sides
  // ω² m = 2α 4 as it jumps, and ω² m (4² + 1²)/12 = 2α (4³ + 1³)/12 as it rocks.
  WorkingScene bar;
  bar.cover = "rigid";
  bar.bodies = box("base", -5, -1, 9, 0, R"("fixed": true)") + ", " + box("bar", 0, 0, 4, 1);
  bar.interface = stiff(1e10, 0);
  const double mass = 4 * 2300, jumping = 2 * 1e10 * 4 / mass, rocking = 2 * 1e10 * 65 / (17 * mass);
  REQUIRE(rocking < jumping);
  const Judged judged = judge(bar, {{0, 0}, {0, -1e-4}});
  CHECK(judged.voted == Approx(2 / std::sqrt(jumping)).epsilon(1e-9));
  CHECK(judged.ratio() >= 1);
  bar.law = "vertex_edge";
  CHECK(vote_of(bar.read()).dt == Approx(2 / std::sqrt(3 * rocking)).epsilon(1e-9));
}

TEST_CASE("penalty supports and tangential springs vote, too", "[simulation][time_step]") {
  WorkingScene held;
  held.bodies = box("a", 0, 0, 1, 1, R"("surfaces": {"below": [0]})");
  held.rest =
      R"("prescribed": [{"body": "a", "surface": "below", "stiffness": 1e12, "displacement": [0, 0]}],)";
  const Judged support = judge(held, {{0, 0}});
  CHECK(support.ratio() >= 1 - 1e-6);
  CHECK(support.ratio() <= 2);

  WorkingScene sheared = cross(1e10, "rigid", "");
  sheared.interface = stiff(1e10, 1e12);
  CHECK(judge(sheared, pressed(1e-4)).ratio() >= 1 - 1e-6);
}

TEST_CASE("a block on a base is stable just below its exact limit and not above", "[simulation][time_step]") {
  // Rigid, 1 x 1 m, flat on a fixed base without friction: ω² = α L / m, up and down.
  const double stiffness = 1e10, mass = 2300, sunk = mass * 1 / stiffness;
  const double limit = 2 / std::sqrt(stiffness / mass);
  const double disturbed = 1e-3 * sunk;
  const auto largest_swing = [&](double share) {
    WorkingScene text;
    text.gravity = "[0, -1]";
    text.law = "frictionless";
    text.interface = R"("normal_stiffness": 1e10, "normal_damping": 0)";
    text.bodies = box("base", -1, -1, 2, 0, R"("fixed": true)") + ", " +
                  box("block", 0, -sunk - disturbed, 1, 1 - sunk - disturbed);
    const double dt = share * limit;
    text.time = fmt::format(R"({{"end": {:.17g}, "dt": {:.17g}}})", 40 * dt, dt);
    text.output = fmt::format(R"({{"history": {:.17g}}})", dt);
    text.rest = R"("limits": {"energy_residual": 1e9},)";
    Simulation simulation(text.read(), {});
    CHECK(simulation.critical_dt() <= limit);
    CHECK(simulation.critical_dt() >= limit / 3);
    double swing = 0;
    for (int step = 0; step < 20 && simulation.advance(); ++step) {
      swing = std::max(swing, std::abs(simulation.body_motion(1).displacement.y - disturbed));
    }
    return swing / disturbed;
  };
  CHECK(largest_swing(0.5) < 1.3);
  CHECK(largest_swing(0.98) < 6);  // 1/√(1 − 0.98²) = 5.03: a leapfrog swings wider near its limit
  CHECK(largest_swing(1.02) > 100);
}

TEST_CASE("mass ratio 1e6: the small body votes", "[simulation][time_step]") {
  WorkingScene text;
  text.interface = stiff(1e10, 0);
  text.bodies = box("large", 0, 0, 10, 10) + ", " + box("small", 5, 10, 5.01, 10.01);
  const CriticalStep vote = vote_of(text.read());
  text.bodies = box("large", 0, 0, 10, 10) + ", " + box("large too", 0, 10, 10, 20);
  const CriticalStep alone = vote_of(text.read());
  // ω² ∝ α L/m: lengths as 1e3, masses as 1e6.
  CHECK(alone.dt / vote.dt > 20);
  CHECK(alone.dt / vote.dt < 1e3);
}

TEST_CASE("who is near decides how contacts between moving bodies count", "[simulation][time_step]") {
  WorkingScene text;
  text.cover = "block";
  text.bodies = box("base", -5, -1, 5, 0, R"("fixed": true)") + ", " + box("block", 0, 0, 1, 1) + ", " +
                box("pebble", 3, 0, 3.25, 0.25);
  text.interface = stiff(1e11, 1e11);
  const Scene scene = text.read();
  const Model model = build_model(scene);
  const StepVote votes(scene, settings_of(scene), model, ContactStage(scene, model, alone(), true));
  constexpr double nobody = std::numeric_limits<double>::infinity();
  const double block = model.bodies[1].contact_mass, pebble = model.bodies[2].contact_mass;
  // Both may meet both: the bound does not care who is where.
  CHECK(votes.among(std::array{nobody, pebble, block}).dt == Approx(votes.anyhow().dt).epsilon(1e-14));
  // With the base alone it may be longer, and is no longer than that of a scene without anybody else.
  text.bodies = box("base", -5, -1, 5, 0, R"("fixed": true)") + ", " + box("pebble", 3, 0, 3.25, 0.25);
  const double apart = votes.among(std::array{nobody, nobody, nobody}).dt;
  CHECK(apart > 1.02 * votes.anyhow().dt);
  CHECK(apart <= vote_of(text.read()).dt * (1 + 1e-12));
}

TEST_CASE("the step is cut as two bodies come near each other, with the skin or without",
          "[simulation][time_step]") {
  // Strain modes are stiff enough for the bound of everything to limit the step, and soft enough for
  // neighbours to count.
  WorkingScene text;
  text.cover = "block";
  text.material =
      R"("density": 2300, "model": "linear_elastic", "young_modulus": 1.6e9, "poisson_ratio": 0.25)";
  text.bodies = box("left", 0, 0, 1, 1, R"("velocity": [1, 0])") + ", " + box("right", 2, 0, 3, 1) + ", " +
                box("base", 20, 0, 21, 1, R"("fixed": true)");
  text.interface = stiff(1e9, 1e9);
  text.time = R"({"end": 1.5, "safety": 0.4})";
  text.output = R"({"history": 0.25})";
  std::vector<std::vector<std::uint64_t>> steps(2);
  for (const bool skin : {true, false}) {
    Simulation simulation(text.read(), {.neighbour_skin = skin});
    simulation.advance();
    for (std::uint64_t before = 0; simulation.advance(); before = simulation.summary().steps)
      steps[skin].push_back(simulation.summary().steps - before);
  }
  CHECK(steps[0] == steps[1]);
  // Near means within a tenth of the width: after 0.9 s or so. They hit after 1 s.
  REQUIRE(steps[0].size() == 6);
  CHECK(steps[0][2] == steps[0][0]);
  CHECK(20 * steps[0][4] > 21 * steps[0][0]);
}

TEST_CASE("a bounce is judged by the springs, stability by the strain modes as well",
          "[simulation][time_step]") {
  WorkingScene text = cross(1e8, "block", R"("fixed": true)");
  const CriticalStep strained = vote_of(text.read());
  // 1e8 Pa/m on a side against 1.6e10 Pa over 1 m: the springs alone are far slower.
  CHECK(strained.spring_dt > 3 * strained.dt);
  CHECK(automatic_step(strained, 0.2) == Approx(0.8 * strained.dt).epsilon(1e-14));
  CHECK(automatic_step(strained, 0.01) == Approx(0.01 * strained.spring_dt).epsilon(1e-14));
  text.cover = "rigid";
  const CriticalStep unstrained = vote_of(text.read());
  CHECK(unstrained.spring_dt == Approx(unstrained.dt).epsilon(1e-14));
  text.bodies = box("middle", 0, 0, 1, 1);
  text.cover = "block";
  const CriticalStep alone = vote_of(text.read());
  CHECK(automatic_step(alone, 0.3) == Approx(0.3 * alone.dt).epsilon(1e-14));
}

TEST_CASE("two equals bounce off each other with 0.987 to 1.013 of their speed at the automatic step",
          "[simulation][time_step]") {
  constexpr int phases = 16;
  for (const char* cover : {"rigid", "block"}) {
    for (const double height : {1.0, 0.5, 0.1}) {
      WorkingScene pair;
      pair.cover = cover;
      pair.interface = stiff(1e10, 0);
      pair.time = R"({"end": 0.05})";
      pair.output = R"({"history": 0.05})";
      pair.rest = R"("limits": {"energy_residual": 1},)";
      for (int phase = 0; phase < phases; ++phase) {
        const double gap = 0.01 + phase * 1e-4 / phases;  // a step passes less than 1e-4 m
        pair.bodies = box("below", 0, 0, 1, height, R"("velocity": [0, 1])") + ", " +
                      box("above", 0, height + gap, 1, 2 * height + gap);
        const Simulation simulation = run_to_end(pair);
        const double speed = simulation.body_motion(1).velocity.y - simulation.body_motion(0).velocity.y;
        const EnergyLedger& ledger = simulation.ledger();
        INFO(cover << ", height " << height << " m, phase " << phase << ": parts with " << speed << " m/s");
        REQUIRE(speed > 0.9);
        // Vibration counts as what it was made of. A quarter of m v² is that of the approach.
        const double approach = 2300 * height / 4;
        CHECK(std::abs(ledger.residual) < (1.013 * 1.013 - 1) * approach);
      }
    }
  }
}

TEST_CASE("slabs on columns come to rest at the automatic step, whatever dashpots meet on a side",
          "[simulation][time_step]") {
  for (const char* cover : {"rigid", "block"}) {
    for (const int columns : {2, 8}) {
      INFO(cover << ", " << columns << " columns under and over a slab of the mass of each");
      WorkingScene stack;
      stack.cover = cover;
      stack.gravity = "[0, -10]";
      stack.interface = R"("normal_stiffness": 1e10, "tangential_stiffness": 1e10, "friction_angle": 30,
                           "normal_damping": 1, "tangential_damping": 1)";
      stack.bodies = box("base", -1, -1, 5, 0, R"("fixed": true)");
      const double width = 4.0 / columns, height = 0.5 * columns;
      for (const int storey : {0, 1}) {
        const double bottom = storey * (height + 0.5);
        for (int i = 0; i < columns; ++i)
          stack.bodies += ", " + box(fmt::format("column {} {}", storey, i), i * width, bottom,
                                     (i + 1) * width, bottom + height);
        if (storey == 0) stack.bodies += ", " + box("slab", 0, height, 4, height + 0.5);
      }
      stack.time = R"({"end": 0.4})";
      stack.output = R"({"history": 0.4})";
      const Simulation simulation = run_to_end(stack);
      CHECK(simulation.ledger().kinetic < 1e-3 * simulation.ledger().throughput);
      CHECK(simulation.summary().largest_residual_share < 1e-3);
    }
  }
}

TEST_CASE("who is near does not weaken supports", "[simulation][time_step]") {
  WorkingScene text;
  text.interface = stiff(1e3, 1e3);
  text.bodies =
      box("held", 0, 0, 1, 1, R"("surfaces": {"below": [0]})") + ", " + box("pebble", 40, 0, 40.1, 0.1);
  text.rest =
      R"("prescribed": [{"body": "held", "surface": "below", "stiffness": 1e10, "displacement": [0, 0]}],)";
  const Scene scene = text.read();
  const Model model = build_model(scene);
  const StepVote votes(scene, settings_of(scene), model, ContactStage(scene, model, alone(), true));
  constexpr double nobody = std::numeric_limits<double>::infinity();
  const CriticalStep apart = votes.among(std::array{nobody, nobody});
  CHECK(apart.spring_dt == Approx(votes.anyhow().spring_dt).epsilon(1e-12));
  CHECK(apart.dt == Approx(votes.anyhow().dt).epsilon(1e-12));
  CHECK(limiter_of_automatic(scene, apart) == "body 'held': its contacts and supports");
}
