// Time per element and step of one free body of many elements: patches, strain, stress, update.

#include "lattice.hpp"

#include "scenes.hpp"

#include "simulation/simulation.hpp"

#include <benchmark/benchmark.h>

#include <fmt/format.h>

#include <cmath>

namespace talus::benchmarks {
namespace {

constexpr double element_steps_per_iteration = 5e6;

/// A square of 10 m that was struck at a corner.
std::string square(double size, const char* material, const char* slivers) {
  return fmt::format(
      R"({{"talus": 1, "materials": {{"rock": {{"density": 2300, "model": "{}", "young_modulus": 1e10,
            "poisson_ratio": 0.25}}}},
          "cover": {{"model": "hexagonal", "size": {}, "slivers": "{}"}},
          "bodies": [{{"name": "a", "polygon": [[0, 0], [10, 0], [10, 10], [0, 10]], "material": "rock"}}],
          "loads": [{{"body": "a", "point": [10, 10], "force": [-1e6, -2e5]}}],
          "time": {{"end": 1000}}}})",
      material, size, slivers);
}

void measure(benchmark::State& state, const std::string& text) {
  Scene scene = scene_of_text(text);
  const Simulation sample(scene, {});
  const double dt = 0.5 * sample.critical_dt();
  const auto elements = static_cast<double>(sample.element_count());
  scene.time.dt = dt;
  scene.output.history = std::ceil(element_steps_per_iteration / elements) * dt;
  Simulation simulation(scene, {});
  simulation.advance();
  const std::uint64_t before = simulation.summary().steps;
  for (auto iteration : state) {
    (void)iteration;
    simulation.advance();
  }
  const double done = elements * static_cast<double>(simulation.summary().steps - before);
  using benchmark::Counter;
  state.counters["elements"] = elements;
  state.counters["ns_per_element_step"] = Counter(done * 1e-9, Counter::kIsRate | Counter::kInvert);
}

}  // namespace

void register_lattices() {
  for (const double size : {1.0, 0.3, 0.1}) {
    for (const char* material : {"linear_elastic", "hypoelastic"}) {
      for (const char* slivers : {"merge", "mass_scale"}) {
        benchmark::RegisterBenchmark(
            fmt::format("lattice/{}/{}/{}", size, material, slivers).c_str(),
            [text = square(size, material, slivers)](benchmark::State& state) { measure(state, text); })
            ->Iterations(5)
            ->UseRealTime()
            ->Unit(benchmark::kMillisecond);
      }
    }
  }
}

}  // namespace talus::benchmarks
