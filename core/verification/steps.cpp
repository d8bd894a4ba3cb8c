#include "verification/case.hpp"
#include "verification/course.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace talus::verification {
namespace {

constexpr double block_weight = 2300, stiffness_of_base = 1e10;  // kg/m, N/m per m: a square of 1 m

/// A rigid square that cannot turn, thrown at a fixed base with 1 m/s from `gap` m away.
Scene thrown_flat(const Bench& bench, const std::string& cover, double speed, double thickness) {
  return bench.from_text(fmt::format(
      R"({{"talus": 1, "materials": {{{}}}, "cover": {{"model": "{}"}}, "contact": {{"model": "frictionless"}},
          "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e10, "normal_damping": 0}}],
          "bodies": [
            {{"name": "base", "polygon": [[-4, -2], [4, -2], [4, 0], [-4, 0]], "material": "rock", "fixed": true}},
            {{"name": "block", "polygon": {}, "material": "rock", "velocity": [0, {}], "fix": ["x", "rotation"]}}],
          "limits": {{"energy_residual": 1e9}}, "time": {{"end": 1}}, "output": {{"history": 1}}}})",
      rock_text, cover,
      polygon_text({{0, 0.001}, {1, 0.001}, {1, 0.001 + thickness}, {0, 0.001 + thickness}}), -speed));
}

struct Range {
  double least, most;
};

/// Speed after over speed before, over all phases of the step in which the square touches.
Range restitution(const Bench& bench, double share) {
  const double critical = 2 / std::sqrt(stiffness_of_base / block_weight), dt = share * critical;
  Range range{1e300, -1e300};
  constexpr int phases = 400;
  Scene scene = thrown_flat(bench, "rigid", 1, 1);
  scene.time.dt = dt;
  // Whole steps, and enough of them to be through the contact, which lasts π/2 of the critical step or more.
  const double steps = std::ceil((1.2e-3 + 4 * critical) / dt);
  scene.time.end = scene.output.history = steps * dt;
  for (int phase = 0; phase < phases; ++phase) {
    Scene moved = scene;
    for (Vec2& vertex : moved.bodies[1].outer.vertices) vertex.y += dt * phase / phases;
    double after = 0;
    run_through(moved, {},
                [&](const Simulation& simulation) { after = simulation.body_motion(1).velocity.y; });
    range = {std::min(range.least, after), std::max(range.most, after)};
  }
  return range;
}

void bounce_by_step(const Bench& bench, Rows& rows) {
  struct Due {
    double share, least, most, off;
  };
  // A mass on a one-sided spring under central differences, over all phases; rounded to the digits given.
  for (const Due due : {Due{0.1, 0.996, 1.004, 1e-3},
                        {0.2, 0.987, 1.013, 1e-3},
                        {0.35, 0.94, 1.06, 0.01},
                        {0.6, 0.80, 1.25, 0.01},
                        {0.9, 0.45, 2.24, 0.02}}) {
    const Range found = restitution(bench, due.share);
    rows.about(Kind::analytic, fmt::format("Δt/Δt_c = {}: least restitution", due.share), found.least,
               due.least, due.off, "");
    rows.about(Kind::analytic, fmt::format("Δt/Δt_c = {}: largest restitution", due.share), found.most,
               due.most, due.off, "");
  }
}

/// A rigid square on a two-sided penalty support is a linear oscillator: beyond the critical step it grows by
/// the same factor in every step.
double growth_per_step(const Bench& bench, double share) {
  Scene scene = bench.from_text(fmt::format(
      R"({{"talus": 1, "materials": {{"rock": {{"density": 2300}}}}, "cover": {{"model": "rigid"}},
          "bodies": [{{"name": "block", "polygon": [[0, 0], [1, 0], [1, 1], [0, 1]], "material": "rock",
                      "surfaces": {{"below": [0]}}, "velocity": [0, 1e-9], "fix": ["x", "rotation"]}}],
          "prescribed": [{{"body": "block", "surface": "below", "stiffness": {}, "displacement": [null, 0]}}],
          "limits": {{"energy_residual": 1e300}}, "time": {{"end": 1}}, "output": {{"history": 1}}}})",
      stiffness_of_base));
  const double dt = share * 2 / std::sqrt(stiffness_of_base / block_weight);
  scene.time.dt = scene.output.history = dt;
  scene.time.end = 30 * dt;
  std::vector<double> place;
  run_through(scene, {}, [&](const Simulation& simulation) {
    place.push_back(std::abs(simulation.body_motion(0).displacement.y));
  });
  return place.size() < 20 ? std::nan("") : place[19] / place[18];
}

void beyond_critical(const Bench& bench, Rows& rows) {
  for (const double share : {1.01, 1.2}) {
    const double r = 2 * share * share - 1;
    rows.near(Kind::analytic, fmt::format("Δt/Δt_c = {}: growth per step, support of a rigid block", share),
              growth_per_step(bench, share), r + std::sqrt(r * r - 1), 2e-3, "");
  }
  for (const double share : {1.01, 1.2, 2.0}) {
    Scene scene = thrown_flat(bench, "block", 0, 1);
    scene.limits.energy_residual = 0.05;
    scene.gravity = {0, -10};
    scene.bodies[1].support = {};
    const double dt = share * Simulation(scene, {}).critical_dt();
    scene.time.dt = dt;
    scene.output.history = 20 * dt;  // no output time makes the step smaller
    rows.says(fmt::format("elastic block, Δt/Δt_c = {}: stops and", share), trouble_of(scene),
              {"step", "critical"});
  }
}

void below_critical(const Bench& bench, Rows& rows) {
  for (const double share : {0.1, 0.2, 0.4, 0.6, 0.9}) {
    Scene scene = bench.shipped("column", {{"/output", R"({"history": 1})"}, {"/time/end", "0.3"}});
    scene.time.dt = share * Simulation(scene, {}).critical_dt();
    Vec2 moved{};
    std::string trouble;
    const std::uint32_t top = body_number(scene, "b10");
    run_through(scene, {},
                [&](const Simulation& simulation) { moved = simulation.body_motion(top).displacement; });
    constexpr double due = 2300 * 10 / 1e10 * 55 + 2300 * 10 * (1 - 0.0625) / 1e10 * (50 - 0.25);
    rows.near(Kind::analytic, fmt::format("column, Δt/Δt_c = {}: the top sinks by", share), -moved.y, due,
              1e-3, "m");
  }
}

/// The reader refuses an overlap; made behind its back, it throws the block out, and the run says so.
void initial_overlap(const Bench& bench, Rows& rows) {
  Scene scene = thrown_flat(bench, "rigid", 0, 1);
  scene.time.end = scene.output.history = 0.05;
  scene.time.safety = 0.05;
  for (Vec2& vertex : scene.bodies[1].outer.vertices) vertex.y -= 2e-3;
  double speed = 0;
  RunSummary summary;
  run_through(scene, {}, [&](const Simulation& simulation) {
    speed = simulation.body_motion(1).velocity.y;
    summary = simulation.summary();
  });
  rows.near(Kind::analytic, "1 mm of overlap ejects with d₀ √(α L/m)", speed,
            1e-3 * std::sqrt(stiffness_of_base / block_weight), 2e-3, "m/s");
  rows.says("the run warns", summary.warnings.empty() ? "" : summary.warnings[0], {"block", "base", "0.001"});
  std::string refused;
  try {
    bench.from_text(fmt::format(R"({{"talus": 1, "materials": {{{}}}, "contact": {{"model": "frictionless"}},
        "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e10, "normal_damping": 0}}],
        "bodies": [{{"name": "base", "polygon": [[-4, -2], [4, -2], [4, 0], [-4, 0]], "material": "rock", "fixed": true}},
                   {{"name": "block", "polygon": [[0, -1e-3], [1, -1e-3], [1, 1], [0, 1]], "material": "rock"}}],
        "time": {{"end": 1}}}})",
                                rock_text));
  } catch (const SceneError& error) {
    refused = error.mistakes.empty() ? error.what() : error.mistakes[0].text();
  }
  rows.says("the reader refuses it", refused, {"overlap", "base"});
}

/// A plate of 1 cm is held up to what its spring stores, and stopped with words beyond; it never passes
/// unseen.
void fast_thin_plates(const Bench& bench, Rows& rows) {
  constexpr double thickness = 0.01;
  const auto plate = [&](double speed) {
    Scene scene = bench.from_text(fmt::format(
        R"({{"talus": 1, "materials": {{"rock": {{"density": 2300}}}}, "cover": {{"model": "rigid"}},
            "contact": {{"model": "frictionless"}},
            "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e10, "normal_damping": 0}}],
            "bodies": [
              {{"name": "plate", "polygon": [[-1, -0.01], [1, -0.01], [1, 0], [-1, 0]], "material": "rock", "fixed": true}},
              {{"name": "flyer", "polygon": [[0, 0.02], [0.5, 0.02], [0.5, 0.03], [0, 0.03]], "material": "rock",
                "velocity": [0, {}]}}],
            "time": {{"end": {:.17g}, "safety": 0.02}}, "output": {{"history": 1}}}})",
        -speed, 0.06 / speed));
    return scene;
  };
  const double omega = std::sqrt(stiffness_of_base / (2300 * thickness));
  double back = 0, depth = 0;
  run_through(plate(30), {}, [&](const Simulation& simulation) {
    back = simulation.body_motion(1).velocity.y;
    depth = simulation.summary().largest_penetration;
  });
  rows.near(Kind::analytic, "30 m/s: comes back with", back, 30, 1e-3, "m/s");
  rows.near(Kind::analytic, "30 m/s: overlap v/ω", depth, 30 / omega, 1e-3, "m");
  // The centre would pass mid-plane at (H/2) ω = 104 m/s; the plate would fly through at √(αH/2ρ) = 147 m/s.
  for (const double speed : {100.0, 150.0, 1e3, 1e4, 1e6})
    rows.says(fmt::format("{:g} m/s: stops and", speed), trouble_of(plate(speed)),
              {"too deep", "flyer", "plate"});
}

}  // namespace

std::span<const Case> step_cases() {
  static constexpr Case cases[] = {
      {"extremes", "bounce_by_step",
       "A contact begins and ends between two steps: a bounce gains or loses by the phase, more the longer "
       "the step.",
       2, bounce_by_step},
      {"extremes", "below_critical", "What comes to rest does not depend on the step.", 4, below_critical},
      {"extremes", "beyond_critical",
       "Beyond the critical step motion grows by r + √(r²−1), r = 2(Δt/Δt_c)² − 1, per step, and the run "
       "stops with words.",
       1, beyond_critical},
      {"extremes", "initial_overlap",
       "An initial overlap is refused; one that comes about is warned of and ejects.", 1, initial_overlap},
      {"extremes", "fast_thin_plates",
       "A thin plate comes back with its speed or the run stops with words: nothing passes unseen.", 1,
       fast_thin_plates},
  };
  return cases;
}

}  // namespace talus::verification
