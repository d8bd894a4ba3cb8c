// Time per block and step of whole runs, as users meet them. See README.md beside.

#include "lattice.hpp"
#include "scenes.hpp"

#include "simulation/simulation.hpp"

#include <benchmark/benchmark.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

using namespace talus;
using benchmarks::Load;

constexpr double block_steps_per_iteration = 2e5;
constexpr int iterations = 5;  ///< fixed, so that every machine measures the same stretch of the run

/// A scene, and how long the load takes to run from its base to its top, twice over.
struct Size {
  const char* name;
  const char* generator;
  double warm_up;  ///< s
};

constexpr Size sizes[] = {
    {"column/10", "column.py --blocks 10", 0.02},
    {"column/100", "column.py --blocks 100", 0.15},
    {"brick_wall/106", "brick_wall.py --courses 10 --bricks 10", 0.02},
    {"brick_wall/411", "brick_wall.py --courses 20 --bricks 20", 0.03},
    {"brick_wall/916", "brick_wall.py --courses 30 --bricks 30", 0.04},
};

struct Variant {
  const char* name;
  const char* law;
  bool one_sided;
};

constexpr Variant variants[] = {
    {"overlap_area", "overlap_area", false},
    {"overlap_area_one_sided", "overlap_area", true},
    {"vertex_edge", "vertex_edge", false},
    {"frictionless", "frictionless", false},
};

/// Each iteration advances a fixed number of steps of the automatic size.
void measure(benchmark::State& state, const Load& load, double warm_up, int threads) {
  Scene scene = benchmarks::scene_of(load);
  const double dt = scene.time.safety * Simulation(scene, {}).critical_dt();
  scene.time.dt = dt;
  std::size_t blocks = 0;
  for (const SceneBody& body : scene.bodies) blocks += body.fixed ? 0 : 1;
  const double steps = std::ceil(block_steps_per_iteration / static_cast<double>(blocks));
  scene.output.history = steps * dt;

  Simulation simulation(scene, {.threads = threads});
  while (simulation.time() < warm_up) simulation.advance();
  const std::uint64_t before = simulation.summary().steps;
  for (auto iteration : state) {
    (void)iteration;
    simulation.advance();
  }
  const auto done = static_cast<double>(blocks * (simulation.summary().steps - before));
  using benchmark::Counter;
  state.counters["block_steps_per_second"] = Counter(done, Counter::kIsRate);
  state.counters["ns_per_block_step"] = Counter(done * 1e-9, Counter::kIsRate | Counter::kInvert);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  for (const Size& size : sizes) {
    for (const Variant& variant : variants) {
      for (const int threads : {1, 2}) {
        const Load load{size.generator, variant.law, variant.one_sided};
        const double warm_up = size.warm_up;
        benchmark::RegisterBenchmark(
            fmt::format("{}/{}/threads:{}", size.name, variant.name, threads).c_str(),
            [load, warm_up, threads](benchmark::State& state) { measure(state, load, warm_up, threads); })
            ->Iterations(iterations)
            ->UseRealTime()
            ->Unit(benchmark::kMillisecond);
      }
    }
  }
  benchmarks::register_lattices();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
