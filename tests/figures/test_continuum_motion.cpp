#include "figures/runs.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace talus;
using namespace talus::figures;

namespace {

using std::numbers::pi;
constexpr double density = 2300;

// --- A free bar ------------------------------------------------------------------------------------------

/// A bar of 10 × 0.5 m that is let go at t = 0 in the shape of its first longitudinal mode, on a lattice that
/// lies anywhere.
Scene bar(double size, double safety) {
  std::string wave;
  constexpr int pieces = 100;
  for (int i = 0; i <= pieces; ++i) {
    const double x = -5 + 10.0 * i / pieces;
    wave += fmt::format("{}[{:.17g}, {:.17g}]", i > 0 ? ", " : "", x, std::sin(pi * x / 10));
  }
  return from_text(fmt::format(
      R"({{"talus": 1,
          "materials": {{"rock": {{"density": 2300, "model": "linear_elastic", "young_modulus": 1e10, "poisson_ratio": 0}}}},
          "cover": {{"model": "hexagonal", "size": {}, "offset_x": 0.123, "offset_y": 0.057, "angle": 17}},
          "bodies": [{{"name": "bar", "material": "rock", "polygon": [[-5, -0.25], [5, -0.25], [5, 0.25], [-5, 0.25]],
                      "surfaces": {{"long": [0, 2]}}}}],
          "surface_loads": [{{"body": "bar", "surface": "long", "traction": [{{"scale": 1e5, "x": [{}]}}, 0]}}],
          "settle": {{"duration": 0.05, "damping": "adaptive"}},
          "stages": [{{"name": "free", "from": 2e-4, "set": {{"/surface_loads": []}}}}],
          "time": {{"end": 0.1002, "safety": {}}}, "output": {{"history": 2e-4}}}})",
      size, wave, safety));
}

struct Frequency {
  double value;  ///< Hz
  double dt;
};

/// From the zeros of the share of the first mode in the motion, between the first and the last.
Frequency frequency_of(const Scene& scene) {
  std::vector<double> time, share;
  Simulation simulation(scene, {});
  simulation.settle();
  while (simulation.advance()) {
    double sum = 0;
    for (int i = 0; i < 40; ++i) {
      const double x = -5 + 10 * (i + 0.5) / 40;
      const Vec2 at{x, 0};
      sum += std::sin(pi * x / 10) * (simulation.point_motion(0, at).position.x - x);
    }
    time.push_back(simulation.time());
    share.push_back(sum);
  }
  std::vector<double> zeros;
  for (std::size_t i = 1; i < time.size(); ++i) {
    if (share[i - 1] * share[i] > 0 || share[i] == 0) continue;
    zeros.push_back(time[i - 1] + (time[i] - time[i - 1]) * share[i - 1] / (share[i - 1] - share[i]));
  }
  REQUIRE(zeros.size() > 10);
  return {static_cast<double>(zeros.size() - 1) / 2 / (zeros.back() - zeros.front()),
          simulation.summary().dt};
}

// --- A body cut by a discontinuity -----------------------------------------------------------------------

struct HalfMotion {
  double mass = 0;
  Vec2 momentum, centre;
  double spin = 0;  ///< kg m/s, moment of momentum about the origin
};

/// Of the parts on one side of the line of the cut at the start; their velocity is affine, so that the
/// mid-side rule is exact.
HalfMotion half(const Simulation& simulation, const std::function<bool(Vec2)>& belongs) {
  HalfMotion sum;
  for (const BodyPart& part : simulation.parts(0)) {
    for (const auto& loop : part.loops) {
      const auto start = [&](std::size_t i) {
        const PartPoint& p = loop[i % loop.size()];
        return Vec2{p.position.x - p.displacement.x, p.position.y - p.displacement.y};
      };
      Vec2 middle;
      for (std::size_t i = 0; i < loop.size(); ++i) {
        middle.x += start(i).x / static_cast<double>(loop.size());
        middle.y += start(i).y / static_cast<double>(loop.size());
      }
      if (!belongs(middle)) continue;
      for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
        const Vec2 a = start(0), b = start(i), c = start(i + 1);
        const double mass = density * ((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y)) / 2;
        sum.mass += mass;
        for (const std::size_t k : {std::size_t{0}, i, i + 1}) {
          const PartPoint& p = loop[k];
          sum.momentum.x += mass / 3 * p.velocity.x;
          sum.momentum.y += mass / 3 * p.velocity.y;
          sum.centre.x += mass / 3 * p.position.x;
          sum.centre.y += mass / 3 * p.position.y;
        }
      }
    }
  }
  sum.centre = {sum.centre.x / sum.mass, sum.centre.y / sum.mass};
  return sum;
}

std::string cut_body(const std::string& lines, const std::string& more, double angular_velocity) {
  // Two rows of triangles of size 1: the bottom line has vertices at 0, 1 … 4, the middle one at -0.5 … 4.5.
  const double height = std::sqrt(3.0);
  return fmt::format(
      R"({{"talus": 1,
          "materials": {{"rock": {{"density": 2300, "model": "linear_elastic", "young_modulus": 1e9, "poisson_ratio": 0.25}}}},
          "cover": {{"model": "hexagonal", "size": 1, "offset_x": -2, "offset_y": {1:.17g}, "slivers": "keep"}},
          "contact": {{"model": "frictionless"}},
          "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e9, "normal_damping": 0}}],
          "bodies": [{{"name": "a", "material": "rock", "polygon": [[0, 0], [4, 0], [4, {0:.17g}], [0, {0:.17g}]],
                      "surfaces": {{"below": [0], "above": [2]}},
                      "discontinuities": [{2}], "angular_velocity": {4}}}],
          {3}}})",
      height, -height / 2, lines, more, angular_velocity);
}

}  // namespace

TEST_CASE("Free bar: its first longitudinal frequency, of second order in the size of the lattice",
          "[slow][figures][continuum]") {
  const double exact = std::sqrt(1e10 / density) / 20;
  CHECK(exact == Approx(104.257).margin(1e-3));
  std::vector<double> error;
  for (const double size : {0.5, 0.25, 0.125}) {
    const Frequency found = frequency_of(bar(size, 0.2));
    error.push_back(std::abs(found.value - exact) / exact);
    CHECK(std::pow(2 * pi * exact * found.dt, 2) / 24 < 0.1 * error.back());  // of central differences
  }
  INFO(fmt::format("errors {:.2e}, {:.2e}, {:.2e}", error[0], error[1], error[2]));
  CHECK(error[2] < 5e-5);
  // From one lattice to the next the order scatters, for each cuts the bar in another way.
  CHECK(std::log2(error[0] / error[2]) / 2 > 1.9);
}

TEST_CASE("Spinning body: its elastic energy has no trend", "[figures][continuum]") {
  const Scene scene = from_text(R"({"talus": 1,
      "materials": {"rock": {"density": 2300, "model": "linear_elastic", "young_modulus": 1e9, "poisson_ratio": 0.25}},
      "cover": {"model": "hexagonal", "size": 0.35, "offset_x": 0.1, "angle": 13},
      "bodies": [{"name": "a", "material": "rock", "angular_velocity": 720,
                  "polygon": [[0, 0], [2.1, 0.2], [2.3, 1.1], [1.2, 0.9], [1.1, 1.7], [-0.2, 1.5]],
                  "holes": [[[0.3, 0.4], [0.8, 0.5], [0.6, 1.1]]]}],
      "time": {"end": 10, "safety": 0.8}, "output": {"history": 0.003}})");
  Simulation simulation(scene, {});
  std::vector<double> energy;
  double rotation = 0;
  while (simulation.advance()) {
    energy.push_back(simulation.ledger().strain);
    rotation = simulation.body_motion(0).rotation;
  }
  CHECK(rotation == Approx(20 * 2 * pi).epsilon(1e-3));
  const auto mean = [&](std::size_t from, std::size_t to) {
    double sum = 0;
    for (std::size_t i = from; i < to; ++i) sum += energy[i];
    return sum / static_cast<double>(to - from);
  };
  const std::size_t quarter = energy.size() / 4;
  double scatter = 0;
  const double all = mean(0, energy.size());
  for (const double e : energy) scatter += (e - all) * (e - all) / static_cast<double>(energy.size());
  INFO(fmt::format(
      "turns {:.4f}, energy mean by quarters {:.6e} {:.6e} {:.6e} {:.6e}, scatter {:.2e}, residual {:.1e}",
      rotation / 2 / pi, mean(0, quarter), mean(quarter, 2 * quarter), mean(2 * quarter, 3 * quarter),
      mean(3 * quarter, 4 * quarter), std::sqrt(scatter), simulation.summary().largest_residual_share));
  CHECK(mean(3 * quarter, 4 * quarter) == Approx(mean(0, quarter)).epsilon(0.01));
}

TEST_CASE("Discontinuity: patches and elements as counted by hand", "[figures][continuum]") {
  const double row = std::sqrt(3.0) / 2;
  const auto counts = [](const std::string& lines) {
    const Simulation simulation(from_text(cut_body(lines, R"("time": {"end": 1})", 0)), {});
    return std::pair(simulation.patch_count(), simulation.element_count());
  };
  const auto line = [](double ax, double ay, double bx, double by) {
    return fmt::format(R"({{"points": [[{:.17g}, {:.17g}], [{:.17g}, {:.17g}]]}})", ax, ay, bx, by);
  };
  // 5 + 6 + 5 vertices, 2 (4 + 5) triangles, of which two of each row are halves.
  CHECK(counts("") == std::pair<std::size_t, std::size_t>(16, 18));
  // Through the lower row: its 9 elements and the 5 + 6 patches of its lines of vertices exist twice.
  CHECK(counts(line(-1, row / 2, 5, row / 2)) == std::pair<std::size_t, std::size_t>(27, 27));
  // Along the middle line: no element is cut, its 6 vertices carry two patches each.
  CHECK(counts(line(-1, row, 5, row)) == std::pair<std::size_t, std::size_t>(22, 18));
  // Up to x = 2.1 in the lower row: 4 elements are cut; the patches at 0, 1, -0.5 and 0.5 exist twice.
  CHECK(counts(line(0, row / 2, 2.1, row / 2)) == std::pair<std::size_t, std::size_t>(20, 22));
}

TEST_CASE("Discontinuity: the halves of a spinning body fly apart as two free bodies",
          "[figures][continuum]") {
  // A slanted cut off the centre. The halves leave it along straight lines; they open and slide along the
  // cut.
  const std::string cut = R"({"points": [[-1, 0.2], [5, 1.7]]})";
  const Scene scene =
      from_text(cut_body(cut, R"("time": {"end": 0.2}, "output": {"history": 0.01})", 5 * 180 / pi));
  const auto above = [](Vec2 p) { return p.y > 0.2 + 1.5 / 6 * (p.x + 1); };
  const auto below = [&](Vec2 p) { return !above(p); };
  Simulation simulation(scene, {});
  simulation.advance();
  CHECK(simulation.patch_count() > 16);
  const HalfMotion upper = half(simulation, above), lower = half(simulation, below);
  const double size = std::hypot(upper.momentum.x, upper.momentum.y);
  CHECK(upper.mass + lower.mass == Approx(density * 4 * std::sqrt(3.0)).epsilon(1e-12));
  double total = 0, each = 0, way = 0;
  while (simulation.advance()) {
    const HalfMotion up = half(simulation, above), low = half(simulation, below);
    total =
        std::max({total, std::abs(up.momentum.x + low.momentum.x), std::abs(up.momentum.y + low.momentum.y)});
    each = std::max(
        {each, std::abs(up.momentum.x - upper.momentum.x), std::abs(up.momentum.y - upper.momentum.y)});
    const double t = simulation.time();
    way = std::max({way, std::abs(up.centre.x - upper.centre.x - t * upper.momentum.x / upper.mass),
                    std::abs(up.centre.y - upper.centre.y - t * upper.momentum.y / upper.mass)});
  }
  // Both halves turn by the same angle while their centres go straight on: points that faced each other part
  // by (I + θJ − R) r, r from centre to centre at the start and J the turn by a quarter.
  const Vec2 along{4 / std::hypot(4, 1), 1 / std::hypot(4, 1)}, on_cut{1, 0.7};
  const double step = 1e-6, turn = 5 * simulation.time();
  const auto moved = [&](double side) {
    return simulation.point_motion(0, {on_cut.x - side * along.y, on_cut.y + side * along.x}).displacement;
  };
  const Vec2 apart{moved(step).x - moved(-step).x, moved(step).y - moved(-step).y};
  const Vec2 r{upper.centre.x - lower.centre.x, upper.centre.y - lower.centre.y};
  const Vec2 due{(1 - std::cos(turn)) * r.x - (turn - std::sin(turn)) * r.y,
                 (turn - std::sin(turn)) * r.x + (1 - std::cos(turn)) * r.y};
  INFO(fmt::format(
      "momentum, all {:.1e}, each half {:.1e}, way {:.1e} m, apart by ({:.5f}, {:.5f}) of ({:.5f}, {:.5f}) m",
      total / size, each / size, way, apart.x, apart.y, due.x, due.y));
  CHECK(std::hypot(apart.x - due.x, apart.y - due.y) < 2e-3 * std::hypot(due.x, due.y));
  CHECK(simulation.summary().largest_penetration < 1e-12);
  CHECK(total / size <= 1e-12);
  CHECK(each / size <= 1e-12);
  CHECK(way <= 1e-12);
}
