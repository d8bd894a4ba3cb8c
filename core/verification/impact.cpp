#include "verification/case.hpp"
#include "verification/course.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace talus::verification {
namespace {

/// Of the two blocks of scenes/collision.json: mass m, stiffness α L, speed v0.
constexpr double block_mass = 2800, spring = 2e8, approach = 0.5;

/// How long the faces overlap, from the first to the last of their overlaps in a row, s.
double contact_lasts(const Bench& bench, const std::vector<Override>& more) {
  constexpr double dt = 1e-5;
  std::vector<Override> overrides{
      {"/time/dt", "1e-5"}, {"/time/end", "1.2"}, {"/output", R"({"history": 1e-5})"}};
  overrides.insert(overrides.end(), more.begin(), more.end());
  double first = -1, last = -1;
  run_through(bench.shipped("collision", overrides), {}, [&](const Simulation& simulation) {
    const double front = simulation.point_motion(0, {1, 0.5}).position.x,
                 back = simulation.point_motion(1, {1.5, 0.5}).position.x;
    if (back >= front) return;
    if (first < 0) first = last = simulation.time();
    if (simulation.time() - last < 3 * dt) last = simulation.time();  // later they may ring into each other
  });
  return last - first;
}

void equal_masses(const Bench& bench, Rows& rows) {
  const Scene scene = bench.shipped("collision");
  const std::uint32_t other = body_number(scene, "A");
  double off = 0;
  RunSummary summary;
  std::vector<double> of_a;
  const Course b = run(scene, "B", {}, [&](const Simulation& simulation) {
    const Vec2 a = simulation.body_motion(other).velocity, v = simulation.body_motion(1).velocity;
    off = std::max(off, std::abs(a.x + v.x - approach) / approach);
    summary = simulation.summary();
  });
  double mean = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < b.time.size(); ++i) {
    if (b.time[i] <= 1.1) continue;
    mean += b.motion[i].velocity.x;
    ++count;
  }
  rows.near(Kind::analytic, "v_B afterwards, mean", mean / static_cast<double>(count), 0.49986, 2e-4, "m/s");
  rows.between(Kind::analytic, "v_B at the end", b.motion.back().velocity.x, 0.4990, 0.5, "m/s");
  rows.below(Kind::exact, "momentum in x, error over m v₀", off, 1e-12, "");
  rows.between(Kind::analytic, "contact lasts (rigid 8.3119e-3, elastic bar 8.5754e-3 s)",
               contact_lasts(bench, {}), 8.2e-3, 8.7e-3, "s");
  rows.between(Kind::analytic, "largest overlap (rigid 1.3229e-3, elastic bar 1.2733e-3 m)",
               summary.largest_penetration, 1.27e-3, 1.33e-3, "m");
}

void rigid_blocks(const Bench& bench, Rows& rows) {
  const std::vector<Override> rigid{{"/cover/model", "rigid"}, {"/time/dt", "1e-5"}, {"/time/end", "1.2"}};
  const double omega = std::sqrt(spring / (block_mass / 2));
  double depth = 0, speed = 0;
  run_through(bench.shipped("collision", rigid), {}, [&](const Simulation& simulation) {
    depth = simulation.summary().largest_penetration;
    speed = simulation.body_motion(1).velocity.x;
  });
  rows.about(Kind::analytic, "contact lasts π √(m/2k)", contact_lasts(bench, {{"/cover/model", "rigid"}}),
             std::numbers::pi / omega, 2e-5, "s");
  // Both ends of the overlap are nearer to the sides that meet there: its force is k d (1 − d/L), not k d.
  const double due = approach / omega * (1 + approach / omega / 3);
  rows.near(Kind::analytic, "largest overlap v₀ √(m/2k) (1 + v₀ √(m/2k)/3L)", depth, due, 1e-5, "m");
  rows.near(Kind::analytic, "v_B afterwards", speed, approach, 1e-4, "m/s");
}

/// When the blocks touch between two steps decides on the residual of a run: the worst of some phases.
double largest_residual(const Bench& bench, double dt, const char* damping) {
  constexpr int phases = 8;
  Scene scene = bench.shipped(
      "collision",
      {{"/time/end", "1.1"}, {"/output/frames", "null"}, {"/interfaces/0/normal_damping", damping}});
  scene.time.dt = dt;
  double worst = 0;
  for (int phase = 0; phase < phases; ++phase) {
    Scene moved = scene;
    for (Vec2& vertex : moved.bodies[1].outer.vertices) vertex.x += approach * dt * phase / phases;
    worst = std::max(worst, run_through(moved).largest_residual_share);
  }
  return worst;
}

void order_of_step(const Bench& bench, Rows& rows) {
  for (const char* damping : {"0", "0.1", "0.3"}) {
    const std::array residual{largest_residual(bench, 1e-4, damping), largest_residual(bench, 5e-5, damping),
                              largest_residual(bench, 2.5e-5, damping)};
    const auto name = [&](const char* what) { return fmt::format("{}, dashpots {}", what, damping); };
    rows.below(Kind::bound, name("largest energy residual, Δt = 1e-4 s"), residual[0], 3e-4, "");
    rows.about(Kind::analytic, name("its order, 1e-4 to 5e-5 s"), std::log2(residual[0] / residual[1]), 2,
               0.1, "");
    rows.about(Kind::analytic, name("its order, 5e-5 to 2.5e-5 s"), std::log2(residual[1] / residual[2]), 2,
               0.1, "");
  }
}

void unequal_masses(const Bench& bench, Rows& rows) {
  const Scene scene = bench.shipped("collision_unequal");
  double sum_a = 0, sum_b = 0, count = 0;
  run_through(scene, {}, [&](const Simulation& simulation) {
    if (simulation.time() <= 1.1) return;
    sum_a += simulation.body_motion(body_number(scene, "A")).velocity.x;
    sum_b += simulation.body_motion(body_number(scene, "B")).velocity.x;
    ++count;
  });
  rows.near(Kind::analytic, "v_A afterwards, mean", sum_a / count, 0.25, 5e-3, "m/s");
  rows.near(Kind::analytic, "v_B afterwards, mean", sum_b / count, 0.75, 5e-3, "m/s");
}

using Corners = std::vector<Vec2>;

/// A block that stands on its lower corner, cut off `chamfer` m wide; the tip is at the origin.
Corners on_its_tip(double chamfer) {
  const double half = std::sqrt(0.5);
  Corners corners{{0, 0}};
  if (chamfer > 0) corners = {{chamfer / 2, -chamfer / 2}, {-chamfer / 2, -chamfer / 2}};
  for (const Vec2 corner : {Vec2{-half, -half}, {0, -2 * half}, {half, -half}}) corners.push_back(corner);
  return corners;
}

/// A square turned by 10° whose lower side passes 1 mm above the highest point of `below`.
Corners leaning_over(const Corners& below) {
  const double c = std::cos(std::numbers::pi / 18), s = std::sin(std::numbers::pi / 18);
  double touch = -1e300;
  for (const Vec2 corner : below) touch = std::max(touch, corner.y - s / c * corner.x);
  Corners corners;
  for (const Vec2 p : {Vec2{-0.4, 0}, {0.6, 0}, {0.6, 1}, {-0.4, 1}})
    corners.push_back({p.x * c - p.y * s, p.x * s + p.y * c + touch + 1e-3});
  return corners;
}

Scene falling(const Bench& bench, const Corners& lower, const Corners& upper) {
  return bench.from_text(fmt::format(
      R"({{"talus": 1, "materials": {{{}}}, "contact": {{"model": "frictionless"}},
          "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e10, "normal_damping": 0}}],
          "bodies": [{{"name": "lower", "polygon": {}, "material": "rock"}},
                     {{"name": "upper", "polygon": {}, "material": "rock", "velocity": [0, -2]}}],
          "time": {{"end": 0.03}}, "output": {{"history": 0.03}}}})",
      rock_text, polygon_text(lower), polygon_text(upper)));
}

/// Energy before against energy after, as a share; NaN where the blocks did not meet or did not part.
double missed_by_bounce(Scene scene, double dt) {
  scene.time.dt = dt;
  EnergyLedger ledger;
  const RunSummary summary =
      run_through(scene, {}, [&](const Simulation& simulation) { ledger = simulation.ledger(); });
  if (ledger.contact != 0 || summary.largest_penetration == 0) return std::nan("");
  return std::abs(ledger.residual) / ledger.throughput;
}

void bounces(const Bench& bench, Rows& rows) {
  const Corners square{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, above{{0, 1.001}, {1, 1.001}, {1, 2.001}, {0, 2.001}};
  const auto measure = [&](const std::string& what, const Scene& scene, bool flat) {
    const double critical = Simulation(scene, {}).critical_dt();
    for (const double share : {0.02, 0.002}) {
      const double dt = share * critical;
      // Flat on flat begins with a kink: up to ¼ (ωΔt)² of the energy of approach, half of the whole.
      const double kink = 1e10 / 1150 * dt * dt / 8;
      const std::string name = fmt::format("{}: energy missed, Δt = {:g} Δt_c", what, share);
      rows.below(Kind::bound, name, missed_by_bounce(scene, dt),
                 flat            ? kink
                 : share == 0.02 ? 1e-6
                                 : 1e-8,
                 "");
    }
  };
  measure("flat on flat", falling(bench, square, above), true);
  for (const double chamfer : {0.0, 0.01, 0.002, 1e-6}) {
    const Corners lower = on_its_tip(chamfer);
    measure(chamfer == 0 ? "on a corner" : fmt::format("on a chamfer of {:g} m", chamfer),
            falling(bench, lower, leaning_over(lower)), false);
  }
}

}  // namespace

std::span<const Case> impact_cases() {
  static constexpr Case cases[] = {
      {"impact", "collision",
       "One block hits another of its mass, which moves on but for 0.06 % of vibration; momentum stays to "
       "round-off.",
       4, equal_masses},
      {"impact", "rigid", "The same blocks, rigid, are a mass on a spring: half a period of contact.", 3,
       rigid_blocks},
      {"impact", "order",
       "What the ledger misses in an impact is of second order in the step, with dashpots that may not pull, "
       "too; the worst of eight phases counts.",
       4, order_of_step},
      {"impact", "unequal", "v_A = (r−1)/(r+1) v₀ and v_B = 2r/(r+1) v₀, less some vibration, for r = 3.", 1,
       unequal_masses},
      {"impact", "bounce",
       "A frictionless bounce gives all energy back on every shape: on a corner the force begins smoothly, "
       "flat "
       "on flat with a kink, of which central differences miss up to (ωΔt)²/8.",
       4, bounces},
  };
  return cases;
}

}  // namespace talus::verification
