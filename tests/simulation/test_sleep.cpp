#include "working_scene.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

using namespace talus;

namespace {

constexpr int wall_courses = 4, wall_bricks = 5;

/// A wall in running bond that drops into its joints and is damped to rest within a second.
WorkingScene soft_wall(const std::string& cover) {
  WorkingScene text;
  text.cover = cover;
  text.gravity = "[0, -10]";
  text.material = R"("density": 2000, "model": "linear_elastic", "young_modulus": 1e8, "poisson_ratio": 0.2)";
  text.interface =
      R"("normal_stiffness": 1e8, "tangential_stiffness": 1e8, "friction_angle": 30,
         "normal_damping": 0.3, "tangential_damping": 0.3)";
  text.bodies = box("base", -1, -1, wall_bricks + 1, 0, R"("fixed": true)");
  for (int c = 0; c < wall_courses; ++c) {
    for (int i = 0; i < wall_bricks; ++i) {
      const double left = i + 0.25 * (c % 2);
      text.bodies += ", " + box(fmt::format("b{}_{}", c, i), left, c, left + 1, c + 1);
    }
  }
  text.rest = R"("damping": 40, "sleep": {"speed": 1e-4, "acceleration": 1e-2, "after": 0.1},)";
  text.time = R"({"end": 2})";
  text.output = R"({"history": 0.1})";
  return text;
}

Scene without_sleep(const WorkingScene& text) {
  Scene scene = text.read();
  scene.sleep.reset();
  return scene;
}

std::uint32_t number_of(const Simulation& simulation, const std::string& name) {
  const std::vector<SceneBody>& bodies = simulation.scene().bodies;
  return static_cast<std::uint32_t>(
      std::find_if(bodies.begin(), bodies.end(), [&](const SceneBody& body) { return body.name == name; }) -
      bodies.begin());
}

void finish(Simulation& simulation) {
  while (simulation.advance()) {
  }
}

/// Largest distance of any body from where it is in another run, m, and of their velocities, m/s.
std::pair<double, double> parted(const Simulation& p, const Simulation& q) {
  double displacement = 0, velocity = 0;
  for (std::size_t b = 0; b < p.body_count(); ++b) {
    const Motion m = p.body_motion(b), n = q.body_motion(b);
    displacement = std::max(
        displacement, std::hypot(m.displacement.x - n.displacement.x, m.displacement.y - n.displacement.y));
    velocity = std::max(velocity, std::hypot(m.velocity.x - n.velocity.x, m.velocity.y - n.velocity.y));
  }
  return {displacement, velocity};
}

/// What the contacts of a body carry upwards, N/m.
double carried_by(const Simulation& simulation, std::uint32_t body) {
  double sum = 0;
  for (const Contact& contact : simulation.contacts()) {
    if (contact.body_b == body) sum += contact.normal_force.y + contact.tangential_force.y;
    if (contact.body_a == body) sum -= contact.normal_force.y + contact.tangential_force.y;
  }
  return sum;
}

}  // namespace

TEST_CASE("a wall at rest sleeps and stays within the bound that is reported", "[simulation][sleep]") {
  WorkingScene text = soft_wall(GENERATE("block", "rigid"));
  text.law = GENERATE("overlap_area", "vertex_edge");
  CAPTURE(text.cover, text.law);
  // Bodies that the loops over blocks leave to others: held in part, and of two pieces.
  text.bodies += ", " + box("ground", 7, -1, 13, 0, R"("fixed": true)") + ", " +
                 box("held", 11, 0, 12, 1, R"("fix": ["x"])");
  std::size_t bodies = wall_courses * wall_bricks + 1;
  if (text.law == "overlap_area") {
    text.bodies += R"(, {"name": "angle", "material": "rock",
                         "polygon": [[8, 0], [10, 0], [10, 1], [9, 1], [9, 2], [8, 2]]})";
    ++bodies;
  }
  Simulation slept(text.read(), {}), awake(without_sleep(text), {});
  finish(slept);
  finish(awake);
  CHECK_FALSE(awake.summary().sleep);
  REQUIRE(slept.summary().sleep);
  const SleepReport report = *slept.summary().sleep;
  CHECK(report.islands >= 1);
  CHECK(report.woken == 0);
  CHECK(report.bodies_asleep == bodies);
  CHECK(report.longest > 0.3);
  CHECK(report.speed < 1e-4);
  CHECK(report.acceleration <= 1e-2);
  CHECK(report.displacement_bound < 1e-2);

  const auto [displacement, velocity] = parted(slept, awake);
  CHECK(displacement <= report.displacement_bound);
  CHECK(velocity <= report.velocity_bound);
  // What still moved was a damped vibration: far below the bound, which knows of nothing that holds it.
  CHECK(displacement < 1e-5);

  const EnergyLedger& ledger = slept.ledger();
  CHECK(ledger.sleep_loss == report.kinetic_energy);
  CHECK(ledger.sleep_loss > 0);
  CHECK(ledger.kinetic == 0);
  CHECK(ledger.contact == Approx(awake.ledger().contact).epsilon(1e-3));
  CHECK(ledger.strain == Approx(awake.ledger().strain).epsilon(1e-3));
  CHECK(residual_share(ledger) < 1.05 * residual_share(awake.ledger()) + 1e-9);

  // What is written of it is as it was before.
  const std::uint32_t lowest = number_of(slept, "b0_2");
  CHECK(carried_by(slept, lowest) == Approx(20000).epsilon(1e-3));
  CHECK(slept.body_motion(lowest).velocity.y == 0);
  CHECK(slept.body_motion(lowest).stress_yy == Approx(awake.body_motion(lowest).stress_yy).epsilon(1e-3));
}

TEST_CASE("a block that falls on a sleeping wall wakes it", "[simulation][sleep]") {
  WorkingScene text = soft_wall(GENERATE("block", "rigid"));
  CAPTURE(text.cover);
  text.bodies += ", " + box("falling", 2.3, 4.35, 3.3, 5.35);
  text.time = R"({"end": 4})";
  Simulation slept(text.read(), {}), awake(without_sleep(text), {});
  const std::uint32_t falling = number_of(slept, "falling"), hit = number_of(slept, "b3_2");
  bool all_but_one = false;
  double apart = 0, moved = 0;
  const double before = slept.body_motion(hit).position.y;
  while (slept.advance()) {
    awake.advance();
    const SleepReport report = *slept.summary().sleep;
    all_but_one = all_but_one || report.bodies_asleep == wall_courses * wall_bricks;
    const auto [displacement, velocity] = parted(slept, awake);
    apart = std::max(apart, displacement);
    moved = std::max(moved, before - slept.body_motion(hit).position.y);
  }
  CHECK(all_but_one);
  const SleepReport report = *slept.summary().sleep;
  CHECK(report.woken >= 1);
  CHECK(report.bodies_asleep == wall_courses * wall_bricks + 1);
  // A thousandth of what the load of the block presses out of one brick.
  CHECK(apart < 1e-6 + 1e-3 * moved);
  CHECK(carried_by(slept, falling) == Approx(20000).epsilon(1e-3));
  CHECK(carried_by(slept, hit) == Approx(carried_by(awake, hit)).epsilon(1e-3));
  CHECK(residual_share(slept.ledger()) < 1.05 * residual_share(awake.ledger()) + 1e-6);
}

TEST_CASE("islands sleep with the same bits for any number of threads, without the skin and at any level",
          "[simulation][sleep]") {
  WorkingScene text = soft_wall("block");
  text.bodies += ", " + box("falling", 2.3, 4.35, 3.3, 5.35);
  // Enough bodies for several chunks: stacks of two beside the wall.
  for (int i = 0; i < 70; ++i) {
    const double left = 10 + 2 * i;
    text.bodies += ", " + box(fmt::format("floor{}", i), left - 0.2, -1, left + 1.2, 0, R"("fixed": true)");
    text.bodies += ", " + box(fmt::format("low{}", i), left, 0, left + 1, 1);
    text.bodies += ", " + box(fmt::format("high{}", i), left, 1, left + 1, 2);
  }
  text.time = R"({"end": 1.6})";
  const auto hash = [&](const RunSettings& settings, SimdLevel level) {
    Scene scene = text.read();
    scene.simd = level;
    Simulation simulation(scene, settings);
    finish(simulation);
    CHECK(simulation.summary().sleep->woken >= 1);
    CHECK(simulation.summary().sleep->islands >= 70);
    return simulation.state_hash();
  };
  const SimdLevel best = text.read().simd;
  const std::string due = hash({}, best);
  CHECK(hash({.threads = 2}, best) == due);
  CHECK(hash({.neighbour_skin = false}, best) == due);
  CHECK(hash({}, SimdLevel::scalar) == due);
}

TEST_CASE("what changes for all wakes all", "[simulation][sleep]") {
  WorkingScene text = soft_wall("block");
  SECTION("a stage that pulls to the side") {
    text.rest += R"("stages": [{"name": "tilt", "from": 1.5, "set": {"/gravity": [2, -10]}}],)";
  }
  SECTION("a stage that takes the friction away") {
    text.rest += R"("stages": [{"name": "ice", "from": 1.5,
                                "set": {"/gravity": [1, -10], "/interfaces/0/friction_angle": 0}}],)";
  }
  SECTION("a stage that loads a brick") {
    text.rest += R"("stages": [{"name": "push", "from": 1.5, "set": {"/loads":
                     [{"body": "b3_2", "point": [2.8, 3.5], "force": [5000, 0]}]}}],)";
  }
  SECTION("ground that shakes") {
    text.rest += R"("base_acceleration": [{"time": [[0, 0], [1.5, 0], [1.6, 1], [1.7, 0]]}, 0],)";
  }
  Simulation slept(text.read(), {}), awake(without_sleep(text), {});
  bool all = false;
  double apart = 0, moved = 0;
  while (slept.advance()) {
    awake.advance();
    all = all || slept.summary().sleep->bodies_asleep == wall_courses * wall_bricks;
    apart = std::max(apart, parted(slept, awake).first);
    const Motion motion = slept.body_motion(number_of(slept, "b3_2"));
    moved = std::max(moved, std::abs(motion.displacement.x));
  }
  CHECK(all);
  CHECK(slept.summary().sleep->woken >= 1);
  CHECK(moved > 1e-4);
  CHECK(apart < 1e-6 + 1e-3 * moved);
  CHECK(residual_share(slept.ledger()) < 1.05 * residual_share(awake.ledger()) + 1e-6);
}

TEST_CASE("what is driven or loaded by the clock stays awake, and so does what it touches",
          "[simulation][sleep]") {
  WorkingScene text = soft_wall("block");
  text.bodies += ", " + box("lone", 8, 0, 9, 1) + ", " + box("ground", 7, -1, 10, 0, R"("fixed": true)");
  SECTION("a load that depends on time") {
    text.rest += R"("loads": [{"body": "b3_2", "point": [2.8, 3.5],
                               "force": [{"time": [[0, 0], [1, 1e-3]]}, 0]}],)";
  }
  SECTION("a drive slower than what counts as rest") {
    text.bodies += ", " + box("driven", -1, 0, 0, 1, R"("drive": {"x": 1e-6, "y": 0, "rotation": 0})");
  }
  SECTION("a body of many elements") {
    text.bodies += ", " + box("many", 1, 4, 2, 5, R"("cover": {"model": "hexagonal", "size": 0.5})");
  }
  Simulation simulation(text.read(), {});
  finish(simulation);
  const SleepReport report = *simulation.summary().sleep;
  CHECK(report.bodies_asleep == 1);
  CHECK(simulation.body_motion(number_of(simulation, "lone")).velocity.y == 0);
  CHECK(simulation.body_motion(number_of(simulation, "b0_2")).velocity.y != 0);
}

TEST_CASE("a body stays awake until the ramp that a stage began is over", "[simulation][sleep]") {
  WorkingScene text;
  text.bodies = box("block", 0, 0, 1, 1, R"("surfaces": {"below": [0]})");
  text.rest = R"("damping": 100, "sleep": {}, "prescribed": [{"body": "block", "surface": "below",
                 "stiffness": 1e9, "displacement": [0, 0]}],
                 "stages": [{"name": "on", "from": 1, "set": {"/prescribed/0/displacement": [1e-5, 0],
                                                              "/prescribed/0/ramp": 1.5}}],)";
  text.time = R"({"end": 4})";
  Simulation simulation(text.read(), {});
  finish(simulation);
  CHECK(simulation.body_motion(0).displacement.x == Approx(1e-5).epsilon(1e-3));
  CHECK(simulation.summary().sleep->islands == 2);  // before the ramp and after it
}

TEST_CASE("a body that sleeps under a load stands still to whoever looks", "[simulation][sleep]") {
  const char* loads[] = {
      R"("loads": [{"body": "block", "point": [0.5, 1], "force": [0, -5000]}],)",
      R"("surface_loads": [{"body": "block", "surface": "top", "pressure": 700}],)",
      R"("prescribed": [{"body": "block", "surface": "top", "stiffness": 1e8, "displacement": [1e-5, null]}],)"};
  for (const char* load : loads) {
    for (const char* held : {"", R"(, "fix": ["rotation"])"}) {
      CAPTURE(load, held);
      WorkingScene text;
      text.gravity = "[0, -10]";
      text.interface =
          R"("normal_stiffness": 1e10, "tangential_stiffness": 1e10, "friction_angle": 30,
             "normal_damping": 0.3, "tangential_damping": 0.3)";
      text.bodies = box("base", -1, -1, 2, 0, R"("fixed": true)") + ", " +
                    box("block", 0, 0, 1, 1, fmt::format(R"("surfaces": {{"top": [2]}}{})", held));
      text.rest = load + std::string(R"("damping": 290, "sleep": {"after": 0.05},)");
      text.time = R"({"end": 0.5})";
      text.output = R"({"history": 0.1})";
      Simulation simulation(text.read(), {});
      finish(simulation);
      REQUIRE(simulation.summary().sleep->bodies_asleep == 1);
      const Motion motion = simulation.body_motion(1);
      CHECK(motion.velocity.x == 0);
      CHECK(motion.velocity.y == 0);
      const Motion corner = simulation.point_motion(1, {1, 1});
      CHECK(corner.velocity.x == 0);
      CHECK(corner.velocity.y == 0);
    }
  }
}

TEST_CASE("what falls asleep in the very step in which kinetic damping stops all wakes at rest",
          "[simulation][sleep]") {
  WorkingScene text;
  text.material = R"("density": 1000, "model": "linear_elastic", "young_modulus": 1e7, "poisson_ratio": 0.3)";
  text.bodies = box("a", 0, 0, 1, 1, R"("velocity": [0.0005, 0])") + ", " +
                box("b", 0, 5, 1, 6, R"("velocity": [0.1, 0])");
  // The kinetic energy of b peaks at 0.053 s, when a, slow from the start, is first looked at.
  text.rest = R"("damping": "kinetic", "sleep": {"speed": 0.001, "acceleration": 1, "after": 0.05},
      "loads": [{"body": "b", "point": [0.5, 5.5],
                 "force": [{"scale": 1000, "time": [[0, 1], [0.0528, 1], [0.0529, -1], [1, -1]]}, 0]}],
      "stages": [{"name": "wake", "from": 0.1, "set": {"/gravity": [0, -1e-9]}}],)";
  text.time = R"({"end": 0.15, "dt": 1e-3})";
  text.output = R"({"history": 1e-3})";
  Simulation simulation(text.read(), {});
  finish(simulation);
  REQUIRE(simulation.summary().sleep);
  REQUIRE(simulation.summary().sleep->woken > 0);
  CHECK(std::abs(simulation.body_motion(0).velocity.x) < 1e-12);
  CHECK(residual_share(simulation.ledger()) < 1e-12);
}
