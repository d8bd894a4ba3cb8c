#include "verification/case.hpp"
#include "verification/course.hpp"

#include <fmt/format.h>

#include <cmath>

namespace talus::verification {
namespace {

struct Pair {
  double a, b, dt;  ///< m/s afterwards; s
};

/// A rigid square of `ratio` times the density hits another of its size with 1 m/s.
Pair hit_by(const Bench& bench, double ratio) {
  const Scene scene = bench.from_text(fmt::format(
      R"({{"talus": 1, "materials": {{"rock": {{"density": {}}}, "light": {{"density": {}}}}}, "cover": {{"model": "rigid"}},
          "contact": {{"model": "frictionless"}},
          "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e10, "normal_damping": 0}}],
          "bodies": [{{"name": "A", "polygon": [[0, 0], [1, 0], [1, 1], [0, 1]], "material": "rock", "velocity": [1, 0]}},
                     {{"name": "B", "polygon": [[1.00001, 0], [2.00001, 0], [2.00001, 1], [1.00001, 1]], "material": "light"}}],
          "time": {{"end": {}, "safety": 0.01}}, "output": {{"history": 1}}}})",
      ratio >= 1 ? 2300 : 2300 * ratio, ratio >= 1 ? 2300 / ratio : 2300, ratio > 1e7 ? 2e-5 : 5e-3));
  Pair pair{};
  run_through(scene, {}, [&](const Simulation& simulation) {
    pair = {simulation.body_motion(0).velocity.x, simulation.body_motion(1).velocity.x,
            simulation.automatic_dt()};
  });
  return pair;
}

void mass_ratio(const Bench& bench, Rows& rows) {
  const double equal = hit_by(bench, 1).dt;
  for (const double ratio : {1e3, 1e6, 1e9, 1e-6}) {
    const Pair found = hit_by(bench, ratio);
    const std::string name = fmt::format("ratio {:g}", ratio);
    // The impact passes 0.01 of a period at a time: a kink costs (ωΔt)²/8 of the energy of approach.
    rows.about(Kind::analytic, name + ": v_A", found.a, (ratio - 1) / (ratio + 1), 1e-4, "m/s");
    rows.about(Kind::analytic, name + ": v_B", found.b, 2 * ratio / (ratio + 1), 1e-4, "m/s");
    if (ratio == 1e6)
      rows.near(Kind::analytic, name + ": Δt over that of equal masses, due 1e-3", found.dt / equal,
                std::sqrt(1 / ratio), 0.01, "");
  }
}

/// A soft block of E = 1e8 Pa under one that is `ratio` times as stiff.
void stiffness_ratio(const Bench& bench, Rows& rows) {
  for (const double ratio : {1e3, 1e6}) {
    const Scene scene = bench.from_text(fmt::format(
        R"({{"talus": 1, "gravity": [0, -10],
            "materials": {{
              "soft": {{"density": 2300, "model": "linear_elastic", "young_modulus": 1e8, "poisson_ratio": 0}},
              "stiff": {{"density": 2300, "model": "linear_elastic", "young_modulus": {}, "poisson_ratio": 0}}}},
            "contact": {{"model": "overlap_area"}},
            "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e10, "tangential_stiffness": 1e10,
                            "friction_angle": 30, "normal_damping": 0.3, "tangential_damping": 0.3}}],
            "bodies": [
              {{"name": "base", "polygon": [[-1, -1], [2, -1], [2, 0], [-1, 0]], "material": "soft", "fixed": true}},
              {{"name": "low", "polygon": [[0, 0], [1, 0], [1, 1], [0, 1]], "material": "soft"}},
              {{"name": "top", "polygon": [[0, 1], [1, 1], [1, 2], [0, 2]], "material": "stiff"}}],
            "damping": 150, "time": {{"end": 0.4}}, "output": {{"history": 0.1}}}})",
        1e8 * ratio));
    const double weight = 2300 * 10;
    const double due = 3 * weight / 1e10 + 1.5 * weight / 1e8 + 0.5 * weight / (1e8 * ratio);
    const Course course = run(scene, "top");
    rows.near(Kind::analytic, fmt::format("ratio {:g}: the stiff block sinks by", ratio),
              -course.motion.back().displacement.y, due, 1e-3, "m");
  }
  // Contacts 1e6 times as stiff as the others: the lower joint gives way, the upper one does not.
  const Scene joints =
      bench.from_text(R"({"talus": 1, "gravity": [0, -10], "materials": {"rock": {"density": 2300}},
      "cover": {"model": "rigid"}, "contact": {"model": "frictionless"},
      "interfaces": [{"between": ["*", "*"], "normal_stiffness": 1e8, "normal_damping": 0.3},
                     {"between": ["stiff", "stiff"], "normal_stiffness": 1e14, "normal_damping": 0.3}],
      "bodies": [
        {"name": "base", "polygon": [[-1, -1], [2, -1], [2, 0], [-1, 0]], "material": "rock", "fixed": true},
        {"name": "low", "polygon": [[0, 0], [1, 0], [1, 1], [0, 1]], "material": "rock", "surfaces": {"stiff": [2]}},
        {"name": "top", "polygon": [[0, 1], [1, 1], [1, 2], [0, 2]], "material": "rock", "surfaces": {"stiff": [0]}}],
      "damping": 200, "time": {"end": 0.3}, "output": {"history": 0.1}})");
  Vec2 low{}, top{};
  run_through(joints, {}, [&](const Simulation& simulation) {
    low = simulation.body_motion(1).displacement;
    top = simulation.body_motion(2).displacement;
  });
  rows.near(Kind::analytic, "joints of 1e8 and 1e14 Pa/m: the lower block sinks by", -low.y,
            2 * 2300 * 10 / 1e8, 1e-6, "m");
  rows.near(Kind::analytic, "and the upper one into it by", low.y - top.y, 2300 * 10 / 1e14, 1e-3, "m");
}

/// A rigid square of any size on a base: it sinks by ρ g h/α, at half of critical damping.
void size(const Bench& bench, Rows& rows) {
  for (const double h : {1e-3, 1.0, 1e3, 1e5}) {
    const double omega = std::sqrt(1e10 / (2300 * h));
    const Scene scene = bench.from_text(fmt::format(
        R"({{"talus": 1, "gravity": [0, -10], "materials": {{"rock": {{"density": 2300}}}}, "cover": {{"model": "rigid"}},
            "contact": {{"model": "frictionless"}},
            "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e10, "normal_damping": 0}}],
            "bodies": [{{"name": "base", "polygon": {}, "material": "rock", "fixed": true}},
                       {{"name": "block", "polygon": {}, "material": "rock"}}],
            "damping": {:.17g}, "time": {{"end": {:.17g}}}}})",
        polygon_text({{-h, -h}, {2 * h, -h}, {2 * h, 0}, {-h, 0}}),
        polygon_text({{0, 0}, {h, 0}, {h, h}, {0, h}}), omega, 60 / omega));
    const Course course = run(scene, "block");
    rows.near(Kind::analytic, fmt::format("square of {:g} m: sinks by", h),
              -course.motion.back().displacement.y, 2300 * 10 * h / 1e10, 1e-9, "m");
    rows.below(Kind::bound, fmt::format("square of {:g} m: turns by", h),
               std::abs(course.motion.back().rotation), 1e-12, "rad");
  }
}

/// Plates of 1 m, ever thinner, on a base.
void slender(const Bench& bench, Rows& rows) {
  for (const double h : {1e-2, 1e-4, 1e-6}) {
    const double omega = std::sqrt(1e10 / (2300 * h));
    const Scene scene = bench.from_text(fmt::format(
        R"({{"talus": 1, "gravity": [0, -10], "materials": {{"rock": {{"density": 2300}}}}, "cover": {{"model": "rigid"}},
            "contact": {{"model": "overlap_area"}},
            "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e10, "tangential_stiffness": 1e10,
                            "friction_angle": 30, "normal_damping": 0, "tangential_damping": 0}}],
            "bodies": [{{"name": "base", "polygon": [[-1, -1], [2, -1], [2, 0], [-1, 0]], "material": "rock", "fixed": true}},
                       {{"name": "plate", "polygon": {}, "material": "rock"}}],
            "damping": {:.17g}, "time": {{"end": {:.17g}}}}})",
        polygon_text({{0, 0}, {1, 0}, {1, h}, {0, h}}), omega, 60 / omega));
    const Course course = run(scene, "plate");
    const double due = 2300 * 10 * h / 1e10;
    // Corners lie up to 1 m from the centre and are rounded there.
    rows.about(Kind::analytic, fmt::format("plate of {:g} m: sinks by", h),
               -course.motion.back().displacement.y, due, 1e-6 * due + 2e-16, "m");
  }
}

}  // namespace

std::span<const Case> ratio_cases() {
  static constexpr Case cases[] = {
      {"extremes", "mass_ratio",
       "v_A = (r−1)/(r+1) v₀ and v_B = 2r/(r+1) v₀ at any ratio r; the step falls with the root of the "
       "lighter mass.",
       3, mass_ratio},
      {"extremes", "stiffness_ratio",
       "Blocks and joints in series give way by the sum of what each gives; the stiff part sets the step.", 6,
       stiffness_ratio},
      {"extremes", "size", "A rigid square sinks by ρgh/α, whether it is 1 mm or 100 km wide.", 1, size},
      {"extremes", "slender", "Plates sink by ρgh/α however thin they are.", 1, slender},
  };
  return cases;
}

}  // namespace talus::verification
