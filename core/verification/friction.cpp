#include "verification/case.hpp"
#include "verification/course.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus::verification {
namespace {

constexpr double in_radians = std::numbers::pi / 180;

/// Mean speed of a rigid block that does not turn under the rule V := 0 at slip: it sticks as a mass on a
/// spring under a suddenly applied load, slips where the spring passes the limit, and starts again.
double creep_of_reset() {
  constexpr double mass = 4600, g = 10, stiffness = 1e10 * 2;  // kg/m, m/s², N/m per m
  const double slope = 30 * in_radians, phi = 38.3 * in_radians, omega = std::sqrt(stiffness / mass);
  const double stick = std::acos(1 - std::tan(phi) / std::tan(slope)) / omega;
  const double leaves_with = g * std::sin(slope) / omega * std::sin(omega * stick);
  const double a = g * (std::tan(phi) * std::cos(slope) - std::sin(slope));
  const double way =
      mass * g * std::cos(slope) * std::tan(phi) / stiffness + leaves_with * leaves_with / (2 * a);
  return way / (stick + leaves_with / a);
}

void creep(const Bench& bench, Rows& rows) {
  for (const char* dt : {"1e-5", "2e-5", "1e-4"}) {
    const Scene scene = bench.shipped("incline", {{"/contact/overlap_area/friction_rule", "paper"},
                                                  {"/cover/model", "rigid"},
                                                  {"/bodies/1/fix", R"(["rotation"])"},
                                                  {"/time/dt", dt}});
    const Course course = run(scene, "block");
    rows.near(Kind::analytic, fmt::format("mean speed 6 to 10 s, Δt = {} s", dt),
              course.moved_between(6, 10) / 4, creep_of_reset(), 0.05, "m/s");
  }
}

double motion_in_3_seconds(const Scene& scene) {
  return run(scene, "block").moved_between(0, 4);
}

void stick(const Bench& bench, Rows& rows) {
  for (const char* law : {"overlap_area", "vertex_edge"}) {
    const Scene scene = bench.shipped("stick_31deg", {{"/contact/model", law}});
    rows.below(Kind::bound, fmt::format("{}: motion in 3 s", law), motion_in_3_seconds(scene), 1e-6, "m");
  }
}

void stick_undamped(const Bench& bench, Rows& rows) {
  for (const char* law : {"overlap_area", "vertex_edge"}) {
    const Course course = run(bench.shipped("stick_31deg", {{"/contact/model", law},
                                                            {"/settle/duration", "1e-6"},
                                                            {"/interfaces/0/normal_damping", "0"},
                                                            {"/interfaces/0/tangential_damping", "0"}}),
                              "block");
    rows.shown(fmt::format("{}: motion in 3 s", law), course.moved_between(0, 4), "m");
    rows.shown(fmt::format("{}: mean speed 2 to 3 s", law), course.moved_between(2, 4), "m/s");
  }
}

/// A rigid block, `width` by 1 m, on a plane of `slope` degrees and friction `angle`: a plane that is level,
/// with gravity turned. It settles for as long as it takes to rest, or hardly, if it is to topple: it would
/// do so before the start.
Scene on_slope(const Bench& bench, double slope, double angle, double width, double end, double settle = 3) {
  return bench.from_text(fmt::format(
      R"({{"talus": 1, "gravity": [{:.17g}, {:.17g}], "materials": {{{}}}, "cover": {{"model": "rigid"}},
          "contact": {{"model": "overlap_area"}},
          "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e12, "tangential_stiffness": 1e12,
                          "friction_angle": {}, "normal_damping": 0.3, "tangential_damping": 0.3}}],
          "bodies": [
            {{"name": "plane", "polygon": [[-9, -1], [40, -1], [40, 0], [-9, 0]], "material": "rock", "fixed": true}},
            {{"name": "block", "polygon": [[0, 0], [{:.17g}, 0], [{:.17g}, 1], [0, 1]], "material": "rock"}}],
          "settle": {{"duration": {}, "damping": "adaptive", "until": 1e-9}}, "time": {{"end": {}}}, "output": {{"history": 0.01}}}})",
      10 * std::sin(slope * in_radians), -10 * std::cos(slope * in_radians), rock_text, angle, width, width,
      settle, end));
}

struct FateOnSlope {
  double moved, turned;  ///< m; rad
  double acceleration;   ///< m/s², from the speed at the end
};

FateOnSlope fate(const Scene& scene) {
  const Course course = run(scene, "block");
  const Motion& last = course.motion.back();
  return {course.moved_between(0, course.time.back() + 1), std::abs(last.rotation),
          last.velocity.x / course.time.back()};
}

/// The four fates of a block: it slides if tan φ < tan α, and topples if b/h < tan α and friction holds it.
void slide_or_topple(const Bench& bench, Rows& rows) {
  const double limit = std::tan(30 * in_radians);
  const auto g_of = [](double slope, double angle) {
    return 10 * (std::sin(slope * in_radians) - std::tan(angle * in_radians) * std::cos(slope * in_radians));
  };
  const FateOnSlope stands = fate(on_slope(bench, 30, 30.5, 2, 2));
  rows.below(Kind::analytic, "φ = 30.5°, b/h = 2: stands, moves in 2 s", stands.moved, 1e-6, "m");
  const FateOnSlope slides = fate(on_slope(bench, 30, 29.5, 2, 2));
  rows.near(Kind::analytic, "φ = 29.5°, b/h = 2: slides with", slides.acceleration, g_of(30, 29.5), 0.01,
            "m/s²");
  const FateOnSlope steep = fate(on_slope(bench, 30, 20, 2, 1));
  rows.near(Kind::analytic, "φ = 20°, b/h = 2: slides with", steep.acceleration, g_of(30, 20), 1e-3, "m/s²");
  const FateOnSlope broad = fate(on_slope(bench, 30, 45, 1.02 * limit, 2));
  rows.below(Kind::analytic, "φ = 45°, b/h = 1.02 tan α: stands, moves in 2 s", broad.moved, 1e-6, "m");
  const FateOnSlope slender = fate(on_slope(bench, 30, 45, 0.98 * limit, 2, 0.05));
  rows.above(Kind::analytic, "φ = 45°, b/h = 0.98 tan α: topples, turned after 2 s by", slender.turned, 0.1,
             "rad");
}

/// At μ = 0 no force along the contact, at the steepest friction that a scene may state no slip.
void extreme_friction(const Bench& bench, Rows& rows) {
  double largest = 0;
  bool touched = false;
  Scene smooth = bench.from_text(fmt::format(
      R"({{"talus": 1, "gravity": [0, -10], "materials": {{{}}}, "contact": {{"model": "overlap_area"}},
          "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e10, "tangential_stiffness": 1e10,
                          "friction_angle": 0, "normal_damping": 0.3, "tangential_damping": 0.3}}],
          "bodies": [
            {{"name": "plane", "polygon": [[-9, -1], [9, -1], [9, 0], [-9, 0]], "material": "rock", "fixed": true}},
            {{"name": "block", "polygon": [[0, 0], [2, 0], [2, 1], [0, 1]], "material": "rock", "velocity": [3, 0]}}],
          "settle": {{"duration": 0.1, "damping": 300}}, "time": {{"end": 1}}, "output": {{"history": 0.01}}}})",
      rock_text));
  const Course course = run(smooth, "block", {}, [&](const Simulation& simulation) {
    for (const Contact& contact : simulation.contacts()) {
      touched = true;
      largest = std::max(largest, magnitude(contact.tangential_force));
    }
  });
  rows.about(Kind::exact, "μ = 0: largest force along the contact", touched ? largest : std::nan(""), 0, 0,
             "N/m");
  rows.about(Kind::exact, "μ = 0: speed lost in 1 s, share", 1 - course.motion.back().velocity.x / 3, 0,
             1e-12, "");
  const double limit = std::tan(60 * in_radians);
  constexpr double steepest = 89.99995;  // μ = 1.1e6
  const FateOnSlope broad = fate(on_slope(bench, 60, steepest, 1.02 * limit, 2));
  rows.below(Kind::analytic, "μ = 1.1e6 on 60°, b/h = 1.02 tan α: moves in 2 s", broad.moved, 1e-6, "m");
  const FateOnSlope slender = fate(on_slope(bench, 60, steepest, 0.98 * limit, 2, 0.05));
  rows.above(Kind::analytic, "μ = 1.1e6 on 60°, b/h = 0.98 tan α: topples, turned after 2 s by",
             slender.turned, 0.1, "rad");
}

/// A ten-minute watch over a block that friction holds.
void ten_minutes(const Bench& bench, Rows& rows) {
  for (const char* law : {"overlap_area", "vertex_edge"}) {
    const Scene scene = bench.shipped(
        "stick_31deg", {{"/contact/model", law}, {"/time/end", "600"}, {"/output/history", "1"}});
    const Course course = run(scene, "block");
    rows.below(Kind::bound, fmt::format("{}: drift from 1 to 600 s", law), course.moved_between(0.5, 601),
               1e-9, "m");
  }
}

}  // namespace

std::span<const Case> friction_cases() {
  static constexpr Case cases[] = {
      {"friction", "creep_of_paper_rule",
       "The paper's rule lets a block that should rest creep: a cycle of stick and slip that has a closed "
       "form "
       "for a rigid block that does not turn.",
       4, creep},
      {"friction", "stick", "Friction of 31° holds a damped and settled block on 30°.", 1, stick},
      {"friction", "stick_undamped",
       "The same block undamped and not settled: no right answer, it rings and creeps.", 1, stick_undamped},
      {"friction", "slide_or_topple",
       "A block slides where tan φ < tan α, and topples where friction holds and b/h < tan α.", 2,
       slide_or_topple},
      {"friction", "extreme",
       "Without friction no force acts along a contact, not even of round-off; with μ = 1.1e6, the largest "
       "that "
       "a scene may state, a block never slides and topples by its shape alone.",
       2, extreme_friction},
      {"friction", "ten_minutes", "Rest is rest: no drift in ten minutes and nine million steps.", 20,
       ten_minutes},
  };
  return cases;
}

}  // namespace talus::verification
