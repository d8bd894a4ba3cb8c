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
void measure(benchmark::State& state, const std::string& generator) {
  const std::string text = generated(generator);
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

}  // namespace

void register_setups() {
  for (const char* shape : {"rectangle", "jittered"}) {
    for (const int blocks : {5000, 50000, 500000}) {
      benchmark::RegisterBenchmark(
          fmt::format("{}setup/pile/{}/{}", blocks > 5000 ? large : "", blocks, shape).c_str(),
          [generator = fmt::format("pile.py --blocks {} --shape {}", blocks, shape)](
              benchmark::State& state) { measure(state, generator); })
          ->Iterations(1)
          ->Unit(benchmark::kMillisecond);
    }
  }
}

}  // namespace talus::benchmarks
