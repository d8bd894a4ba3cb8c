#include "setup.hpp"

#include "scenes.hpp"
#include "step.hpp"

#include "geometry/outlines.hpp"
#include "model/model.hpp"
#include "simulation/simulation.hpp"

#include <benchmark/benchmark.h>

#include <fmt/format.h>

#include <ctime>
#include <string>
#include <vector>

namespace talus::benchmarks {
namespace {

/// Time of this process, s.
double process_time() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <class Work>
double time_of(const Work& work) {
  const double before = process_time();
  work();
  return process_time() - before;
}

/// The whole is timed; parts of it are timed once more by themselves, so they do not add up to it.
void measure(benchmark::State& state, const std::string& text) {
  double reading = 0, overlaps = 0, model = 0, construction = 0;
  double bodies = 0;
  for (auto iteration : state) {
    (void)iteration;
    Scene scene;
    reading += time_of([&] { scene = scene_of_text(text); });
    construction += time_of([&] { benchmark::DoNotOptimize(Simulation(scene, {}).critical_dt()); });
    state.PauseTiming();
    bodies = static_cast<double>(scene.bodies.size());
    std::vector<Loops> shapes;
    for (const SceneBody& body : scene.bodies) shapes.push_back({body.outer.vertices});
    std::vector<const Loops*> pointers;
    for (const Loops& shape : shapes) pointers.push_back(&shape);
    overlaps += time_of([&] { benchmark::DoNotOptimize(overlapping_bodies(pointers).size()); });
    model += time_of([&] { benchmark::DoNotOptimize(build_model(scene).bodies.size()); });
    state.ResumeTiming();
  }
  const auto each = [&](double sum) { return sum / static_cast<double>(state.iterations()); };
  state.counters["bodies"] = bodies;
  state.counters["reading_s"] = each(reading);
  state.counters["overlap_check_s"] = each(overlaps);
  state.counters["construction_s"] = each(construction);
  state.counters["model_s"] = each(model);
}

/// A body under a lattice with far more boundary than it has within: its teeth are as wide as an element.
std::string comb(int teeth) {
  std::string corners = fmt::format("[0, -1], [{}, -1]", 0.1 * teeth);
  for (int i = teeth - 1; i >= 0; --i)
    corners += fmt::format(", [{}, {}], [{}, 0]", 0.1 * i + 0.03, 3 + 0.001 * i, 0.1 * i);
  return fmt::format(R"({{"talus": 1,
    "materials": {{"rock": {{"density": 2000, "model": "linear_elastic", "young_modulus": 1e9, "poisson_ratio": 0.25}}}},
    "cover": {{"model": "hexagonal", "size": 0.05}},
    "bodies": [{{"name": "comb", "material": "rock", "polygon": [{}]}}], "time": {{"end": 1e-6}}}})",
                     corners);
}

/// Rows of Voronoi cells of a metre, 25 to a row, of some 34 elements each.
std::string zones(int rows) {
  return fmt::format(R"({{"talus": 1,
    "materials": {{"rock": {{"density": 2300, "model": "linear_elastic", "young_modulus": 1e10, "poisson_ratio": 0.25}}}},
    "contact": {{"model": "overlap_area"}},
    "interfaces": [{{"between": ["*", "*"], "friction_angle": 30, "normal_stiffness": 1e10,
                     "tangential_stiffness": 1e10, "normal_damping": 0.2, "tangential_damping": 0.2}}],
    "bodies": [],
    "blocks": [{{"name": "cell", "domain": [[0, 0], [{0}, 0], [{0}, 25], [0, 25]], "material": "rock",
                 "cover": {{"model": "hexagonal", "size": 0.3}}, "voronoi": {{"spacing": 1, "seed": 3}}}}],
    "time": {{"end": 1e-6}}}})",
                     rows);
}

}  // namespace

void register_setups() {
  benchmark::RegisterBenchmark("setup/comb/400", [](benchmark::State& state) { measure(state, comb(400)); })
      ->Iterations(1)
      ->Unit(benchmark::kMillisecond);
  for (const int rows : {40, 80}) {
    benchmark::RegisterBenchmark(fmt::format("setup/zones/{}", rows).c_str(),
                                 [rows](benchmark::State& state) { measure(state, zones(rows)); })
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond);
  }
  for (const char* shape : {"rectangle", "jittered"}) {
    for (const int blocks : {5000, 50000, 500000}) {
      benchmark::RegisterBenchmark(
          fmt::format("{}setup/pile/{}/{}", blocks > 5000 ? large : "", blocks, shape).c_str(),
          [generator = fmt::format("pile.py --blocks {} --shape {}", blocks, shape)](
              benchmark::State& state) { measure(state, generated(generator)); })
          ->Iterations(1)
          ->Unit(benchmark::kMillisecond);
    }
  }
}

}  // namespace talus::benchmarks
