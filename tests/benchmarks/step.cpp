#include "step.hpp"

#include "counts.hpp"
#include "scenes.hpp"

#include "simulation/simulation.hpp"

#include <benchmark/benchmark.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace talus::benchmarks {
namespace {

constexpr double block_steps_per_iteration = 2e5;
constexpr double block_steps_of_many_elements = 5e3;
constexpr int iterations = 5;  ///< fixed, so that every machine measures the same stretch of the run

/// A scene, and how long it runs before it is measured.
struct Stack {
  std::string name, generator;
  double warm_up;  ///< s
};

/// Each iteration advances a fixed number of steps of the automatic size.
void measure(benchmark::State& state, const Load& load, double warm_up, int threads) {
  Scene scene = scene_of(load);
  scene.resolved.clear();
  double blocks = 0;
  for (const SceneBody& body : scene.bodies) blocks += body.fixed ? 0 : 1;
  const double dt = Simulation(scene, {}).automatic_dt();
  scene.time.dt = dt;
  const double block_steps = load.cover.empty() ? block_steps_per_iteration : block_steps_of_many_elements,
               steps = std::ceil(block_steps / blocks);
  scene.output.history = steps * dt;

  forget_peak();
  const std::size_t before_model = resident_memory();
  Simulation simulation(std::move(scene), {.threads = threads, .contacts_as_recorded = true});
  while (simulation.time() < warm_up) simulation.advance();
  const std::uint64_t before = simulation.summary().steps;
  for (auto iteration : state) {
    (void)iteration;
    simulation.advance();
  }
  const auto steps_done = static_cast<double>(simulation.summary().steps - before);
  const std::size_t peak = std::max(peak_memory(), before_model);
  const PairCounts pairs = count_pairs(simulation);
  const auto overlapping = static_cast<double>(pairs.overlapping);
  using benchmark::Counter;
  const auto nanoseconds_per = [](double count) {
    return Counter(count * 1e-9, Counter::kIsRate | Counter::kInvert);
  };
  state.counters["block_steps_per_second"] = Counter(blocks * steps_done, Counter::kIsRate);
  state.counters["ns_per_block_step"] = nanoseconds_per(blocks * steps_done);
  if (pairs.overlapping > 0)
    state.counters["ns_per_contact_step"] = nanoseconds_per(overlapping * steps_done);
  state.counters["blocks"] = blocks;
  state.counters["overlapping_pairs"] = overlapping;
  state.counters["candidate_pairs"] = static_cast<double>(pairs.candidates);
  state.counters["bytes_per_block"] = static_cast<double>(peak - before_model) / blocks;
  state.counters["mean_speed"] = mean_speed(simulation);
}

void register_case(const std::string& name, const Load& load, double warm_up) {
  for (const int threads : {1, 2}) {
    auto* registered = benchmark::RegisterBenchmark(
        fmt::format("{}/threads:{}", name, threads).c_str(),
        [load, warm_up, threads](benchmark::State& state) { measure(state, load, warm_up, threads); });
    registered->Iterations(iterations)->Unit(benchmark::kMillisecond);
    // One thread is measured by its own time, which other programs on the machine disturb less.
    if (threads > 1) registered->UseRealTime();
  }
}

/// Scenes at rest, with each law; the load runs from their base to their top, twice over, before the
/// measurement.
void register_laws() {
  const Stack stacks[] = {
      {"column/10", "column.py --blocks 10", 0.02},
      {"column/100", "column.py --blocks 100", 0.15},
      {"brick_wall/106", "brick_wall.py --courses 10 --bricks 10", 0.02},
      {"brick_wall/411", "brick_wall.py --courses 20 --bricks 20", 0.03},
      {"brick_wall/916", "brick_wall.py --courses 30 --bricks 30", 0.04},
  };
  for (const Stack& stack : stacks) {
    for (const char* law : {"overlap_area", "vertex_edge", "frictionless"})
      register_case(fmt::format("{}/{}", stack.name, law), {stack.generator, law, false}, stack.warm_up);
    register_case(stack.name + "/overlap_area_one_sided", {stack.generator, "overlap_area", true},
                  stack.warm_up);
  }
}

/// A wall that has come to rest, followed on or asleep.
void register_rest() {
  for (const bool sleep : {false, true}) {
    register_case(fmt::format("at_rest/411/{}", sleep ? "asleep" : "followed"),
                  {"brick_wall.py --courses 20 --bricks 20", "overlap_area", false, sleep}, 0.45);
  }
}

/// Many blocks, deformable and rigid, with both roles or one; all of them touch soon after the start.
void register_crowds() {
  for (const char* cover : {"block", "rigid"}) {
    for (const int blocks : {504, 5000, 50000}) {
      for (const char* roles : {"symmetric", "priority"}) {
        register_case(fmt::format("{}sliding/{}/{}/{}", blocks > 5000 ? large : "", blocks, cover, roles),
                      {fmt::format("sliding.py --blocks {} --cover {} --roles {}", blocks, cover, roles),
                       "overlap_area", false},
                      blocks > 5000 ? 5e-4 : 2e-3);
      }
    }
    for (const int blocks : {5000, 50000, 500000}) {
      const char* shape = blocks > 50000 ? "rectangle" : "jittered";
      register_case(fmt::format("{}pile/{}/{}/symmetric", blocks > 5000 ? large : "", blocks, cover),
                    {fmt::format("pile.py --blocks {} --shape {} --cover {}", blocks, shape, cover),
                     "overlap_area", false},
                    blocks > 5000 ? 5e-4 : 2e-3);
    }
    register_case(
        fmt::format("{}pile_shuffled/50000/{}/symmetric", large, cover),
        {fmt::format("pile.py --blocks 50000 --listing shuffled --cover {}", cover), "overlap_area", false},
        5e-4);
  }
}

/// Blocks of some thirty elements each, with others near all their sides.
void register_many_elements() {
  for (const int blocks : {32, 126}) {
    register_case(fmt::format("many_elements/{}/symmetric", blocks),
                  {fmt::format("sliding.py --blocks {} --cover block --roles symmetric", blocks),
                   "overlap_area", false, false, R"({"model": "hexagonal", "size": 0.3})"},
                  1e-3);
  }
}

}  // namespace

void register_steps() {
  register_laws();
  register_rest();
  register_crowds();
  register_many_elements();
}

}  // namespace talus::benchmarks
