#include "verification/case.hpp"
#include "verification/course.hpp"

#include <cmath>

namespace talus::verification {
namespace {

constexpr double toe_at_start = -7.243867;  // m along the slope from B
constexpr double braking = 1.839457;        // m/s², on BC

/// Of a rigid block under the pressure that the law gives, g = 10 m/s².
struct SlidingBlock {
  const char* law;
  double speed, peak, peak_at, on_bc_at, stop;  ///< m/s at 2.95 s; m/s, s; s; s
};
constexpr SlidingBlock linear_pressure{"overlap_area", 5.278582, 5.285220, 2.920, 3.186002, 5.869491};
constexpr SlidingBlock two_corners{"vertex_edge", 5.085557, 5.174191, 2.800, 3.195464, 5.881320};

double down_the_slope(Vec2 displacement) {
  return displacement.x * std::sqrt(3.0) / 2 - displacement.y / 2;
}

/// When the block has come `way` metres down the slope, s.
double time_of_way(const Course& course, double way) {
  for (std::size_t i = 1; i < course.time.size(); ++i) {
    const double before = down_the_slope(course.motion[i - 1].displacement),
                 now = down_the_slope(course.motion[i].displacement);
    if (now < way) continue;
    return course.time[i - 1] + (course.time[i] - course.time[i - 1]) * (way - before) / (now - before);
  }
  return std::nan("");
}

/// Extrapolated from the last speed above 0.01 m/s: a stop is not approached smoothly.
double time_of_stop(const Course& course) {
  std::size_t last = 0;
  for (std::size_t i = 0; i < course.time.size(); ++i) {
    if (magnitude(course.motion[i].velocity) > 0.01) last = i;
  }
  return course.time[last] + magnitude(course.motion[last].velocity) / braking;
}

void slide(const Bench& bench, Rows& rows, const SlidingBlock& due) {
  const Scene scene =
      bench.shipped("incline", {{"/contact/model", due.law}, {"/output", R"({"history": 0.001})"}});
  double residual = 0;
  const Course course = run(scene, "block", {}, [&](const Simulation& simulation) {
    residual = simulation.summary().largest_residual_share;
  });
  const std::size_t peak = course.fastest();
  rows.near(Kind::analytic, "v(2.95 s)", course.speed(2.95), due.speed, 2e-3, "m/s");
  rows.near(Kind::analytic, "peak", magnitude(course.motion[peak].velocity), due.peak, 2e-3, "m/s");
  rows.about(Kind::analytic, "time of the peak", course.time[peak], due.peak_at, 2e-3, "s");
  rows.near(Kind::analytic, "heel at B, all of the block on BC", time_of_way(course, 2 - toe_at_start),
            due.on_bc_at, 1e-3, "s");
  rows.near(Kind::analytic, "stop", time_of_stop(course), due.stop, 3e-3, "s");
  const double on_bc = due.stop - due.on_bc_at;  // s, all of it, down to rest
  rows.near(Kind::analytic, "toe past B", toe_at_start + down_the_slope(course.displacement(5.9)),
            2 + braking * on_bc * on_bc / 2, 1e-3, "m");
  rows.below(Kind::bound, "drift from 5.9 to 10 s", course.moved_between(5.9, 10), 1e-6, "m");
  rows.below(Kind::bound, "largest energy residual, share of the throughput", residual, 0.01, "");
}

void slide_on_linear_pressure(const Bench& bench, Rows& rows) {
  slide(bench, rows, linear_pressure);
}

void slide_on_two_corners(const Bench& bench, Rows& rows) {
  slide(bench, rows, two_corners);
}

void laws_part(const Bench& bench, Rows& rows) {
  const auto speed = [&](const char* law) {
    const Scene scene = bench.shipped("incline", {{"/contact/model", law}, {"/time/end", "3"}});
    return run(scene, "block").speed(2.95);
  };
  rows.about(Kind::analytic, "v(2.95 s), overlap_area less vertex_edge",
             speed("overlap_area") - speed("vertex_edge"), linear_pressure.speed - two_corners.speed, 0.01,
             "m/s");
}

/// Undamped and not settled: what the same block does where nothing takes its ringing away.
void as_printed(const Bench& bench, Rows& rows) {
  for (const char* law : {"overlap_area", "vertex_edge"}) {
    const Course course = run(bench.shipped("incline_paper", {{"/contact/model", law}}), "block");
    const std::string name = law;
    rows.shown(name + ": v(2.95 s)", course.speed(2.95), "m/s");
    double least = 1e300, most = 0;
    for (double t = 2.9; t <= 3; t += 0.001) {
      least = std::fmin(least, course.speed(t));
      most = std::fmax(most, course.speed(t));
    }
    rows.shown(name + ": least speed, 2.9 to 3.0 s", least, "m/s");
    rows.shown(name + ": largest speed, 2.9 to 3.0 s", most, "m/s");
    rows.shown(name + ": mean speed after the stop, 6 to 7 s", course.moved_between(6, 7), "m/s");
  }
}

}  // namespace

std::span<const Case> incline_cases() {
  static constexpr Case cases[] = {
      {"incline", "overlap_area",
       "A law that spreads the weight over the base brakes the block by a pressure that is linear along it, "
       "and by a triangle of pressure once its heel lifts.",
       2, slide_on_linear_pressure},
      {"incline", "vertex_edge",
       "A law with a force at either end of the base brakes the block by half the sum of both frictions as "
       "long as it spans the change.",
       2, slide_on_two_corners},
      {"incline", "laws_part", "The two laws part by 0.193 m/s while the block spans the change of friction.",
       1, laws_part},
      {"incline", "as_printed",
       "Undamped and not settled there is no right answer: let go with all its weight unbalanced the block "
       "rings, and friction turns the ringing into motion.",
       2, as_printed},
  };
  return cases;
}

}  // namespace talus::verification
