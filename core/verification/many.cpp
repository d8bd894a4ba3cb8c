#include "verification/case.hpp"
#include "verification/course.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace talus::verification {
namespace {

/// 32 × 32 squares that touch on all sides, under their own weight; ν = 0, so that nothing pushes sideways.
void touching_blocks(const Bench& bench, Rows& rows) {
  constexpr int n = 32;
  std::string bodies =
      R"({"name": "base", "material": "rock", "fixed": true, "polygon": [[-20, -1], [20, -1], [20, 0], [-20, 0]]})";
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double x = i - n / 2.0, y = j;
      bodies += fmt::format(R"(, {{"name": "b{}_{}", "material": "rock", "polygon": {}}})", i, j,
                            polygon_text({{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}}));
    }
  }
  const Scene scene = bench.from_text(fmt::format(
      R"({{"talus": 1, "gravity": [0, -10],
          "materials": {{"rock": {{"density": 2300, "model": "linear_elastic", "young_modulus": 1e10, "poisson_ratio": 0}}}},
          "contact": {{"model": "overlap_area"}},
          "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e10, "tangential_stiffness": 1e10,
                          "friction_angle": 30, "normal_damping": 0.3, "tangential_damping": 0.3}}],
          "bodies": [{}], "damping": 100, "time": {{"end": 0.4, "safety": 0.4}}, "output": {{"history": 0.4}}}})",
      bodies));
  std::vector<Motion> last(scene.bodies.size());
  const RunSummary summary = run_through(scene, {}, [&](const Simulation& simulation) {
    for (std::size_t i = 0; i < last.size(); ++i) last[i] = simulation.body_motion(i);
  });
  const double due = 2300 * 10 / 1e10 * (n * (n + 1) / 2.0) + 2300 * 10 / 1e10 * (n * n / 2.0 - 0.25);
  double least = 1e300, most = 0, aside = 0, uneven = 0;
  for (int i = 0; i < n; ++i) {
    const Motion& top = last[1 + static_cast<std::size_t>(i * n + n - 1)];
    least = std::min(least, -top.displacement.y);
    most = std::max(most, -top.displacement.y);
    for (int j = 0; j < n; ++j) {
      const Vec2 l = last[1 + static_cast<std::size_t>(i * n + j)].displacement,
                 r = last[1 + static_cast<std::size_t>((n - 1 - i) * n + j)].displacement;
      aside = std::max(aside, std::abs(l.x));
      uneven = std::max({uneven, std::abs(l.x + r.x), std::abs(l.y - r.y)});
    }
  }
  rows.near(Kind::analytic, "the top sinks by 528 ρgh/α and its elastic part, least", least, due, 1e-3, "m");
  rows.near(Kind::analytic, "most", most, due, 1e-3, "m");
  rows.below(Kind::exact, "left against right, share of that", uneven / due, 1e-12, "");
  rows.below(Kind::exact, "largest motion aside, share of that", aside / due, 1e-12, "");
  rows.below(Kind::bound, "largest energy residual, share", summary.largest_residual_share, 0.01, "");
}

/// The black squares of a chess board of 101 × 101: each of the 10,000 inner corners is one of two of them.
Scene chess_board(const Bench& bench, const std::string& law, double inwards) {
  constexpr int n = 101;
  std::string bodies;
  for (int i = 0; i < n; ++i) {
    for (int j = i % 2; j < n; j += 2) {
      bodies += fmt::format(
          R"({}{{"name": "b{}_{}", "material": "rock", "polygon": {}, "velocity": [{:.17g}, {:.17g}]}})",
          bodies.empty() ? "" : ", ", i, j,
          polygon_text(
              {{double(i), double(j)}, {i + 1.0, double(j)}, {i + 1.0, j + 1.0}, {double(i), j + 1.0}}),
          inwards * (50 - i), inwards * (50 - j));
    }
  }
  return bench.from_text(fmt::format(
      R"({{"talus": 1, "materials": {{"rock": {{"density": 2300}}}}, "cover": {{"model": "rigid"}}, "contact": {{"model": "{}"}},
          "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e10, "tangential_stiffness": 1e10,
                          "friction_angle": 0, "normal_damping": 0, "tangential_damping": 0}}],
          "bodies": [{}], "time": {{"end": 0.02}}, "output": {{"history": 0.002}}}})",
      law, bodies));
}

void vertices_on_vertices(const Bench& bench, Rows& rows) {
  for (const char* law : {"overlap_area", "vertex_edge"}) {
    Scene rest = chess_board(bench, law, 0);
    rest.time.end = 0.002;
    double largest = 0;
    std::size_t pairs = 0;
    run_through(rest, {}, [&](const Simulation& simulation) {
      pairs = simulation.pair_count();
      for (std::size_t i = 0; i < simulation.body_count(); ++i) {
        const double moved = magnitude(simulation.body_motion(i).displacement);
        largest = moved <= largest ? largest : moved;
      }
    });
    rows.about(Kind::exact, fmt::format("{}: pairs that meet in a vertex", law), static_cast<double>(pairs),
               10000, 0, "");
    rows.about(Kind::exact, fmt::format("{}: at rest, largest motion", law), largest, 0, 0, "m");
  }
  double momentum = 0, residual = 0, depth = 0;
  run_through(chess_board(bench, "overlap_area", 1e-2), {}, [&](const Simulation& simulation) {
    Vec2 sum;
    double size = 0;
    for (std::size_t i = 0; i < simulation.body_count(); ++i) {
      const Vec2 v = simulation.body_motion(i).velocity;
      sum += v;
      size += magnitude(v);
    }
    momentum = std::max(momentum, magnitude(sum) / size);
    residual = simulation.summary().largest_residual_share;
    depth = simulation.summary().largest_penetration;
  });
  rows.above(Kind::bound, "pushed inwards: overlap", depth, 1e-5, "m");
  rows.below(Kind::exact, "pushed inwards: momentum over the sum of all its sizes", momentum, 1e-12, "");
  rows.below(Kind::bound, "pushed inwards: largest energy residual, share", residual, 0.01, "");
}

}  // namespace

std::span<const Case> many_cases() {
  static constexpr Case cases[] = {
      {"extremes", "touching_blocks",
       "32 × 32 blocks that touch settle by Σ kρgh/α and what they compress, and by nothing else; left is as "
       "right.",
       20, touching_blocks},
      {"extremes", "vertices_on_vertices",
       "10,000 vertices on vertices carry nothing while nothing presses, and keep the momentum where "
       "something does.",
       20, vertices_on_vertices},
  };
  return cases;
}

}  // namespace talus::verification
