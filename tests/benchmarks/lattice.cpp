// Time per element and step of one free body of many elements: strain, stress, patches.

#include "lattice.hpp"

#include "scenes.hpp"

#include "simulation/simulation.hpp"

#include <benchmark/benchmark.h>

#include <fmt/format.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace talus::benchmarks {
namespace {

constexpr double element_steps_per_iteration = 5e6, of_large_bodies = 1e8;

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

/// A square of 10 m with 2 cells² triangles, as a file of Gmsh: nodes within are moved, so that no two
/// triangles are alike.
std::string mesh_of_square(int cells) {
  const auto node = [&](int i, int j) { return 1 + i + j * (cells + 1); };
  const double size = 10.0 / cells;
  std::string text = fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", node(cells, cells));
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const double moved = i > 0 && j > 0 && i < cells && j < cells ? 0.2 * size : 0;
      fmt::format_to(std::back_inserter(text), "{} {:.17g} {:.17g} 0\n", node(i, j),
                     i * size + moved * std::sin(7.0 * i + 3 * j),
                     j * size + moved * std::cos(5.0 * i + 11 * j));
    }
  }
  fmt::format_to(std::back_inserter(text), "$EndNodes\n$Elements\n{}\n", 2 * cells * cells);
  for (int j = 0, element = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const int a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
      fmt::format_to(std::back_inserter(text), "{} 2 2 1 1 {} {} {}\n{} 2 2 1 1 {} {} {}\n", element + 1, a,
                     b, c, element + 2, a, c, d);
      element += 2;
    }
  }
  return text + "$EndElements\n";
}

/// The same square as a mesh, which lies in a file as long as it is read.
Scene meshed_square(int cells) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / fmt::format("talus_benchmark_{}.msh", getpid());
  std::ofstream(file) << mesh_of_square(cells);
  Scene scene = scene_of_text(fmt::format(
      R"({{"talus": 1, "materials": {{"rock": {{"density": 2300, "model": "linear_elastic",
            "young_modulus": 1e10, "poisson_ratio": 0.25}}}},
          "cover": {{"model": "mesh"}}, "bodies": [{{"name": "a", "mesh": "{}", "material": "rock"}}],
          "loads": [{{"body": "a", "point": [10, 10], "force": [-1e6, -2e5]}}],
          "time": {{"end": 1000}}}})",
      file.string()));
  std::filesystem::remove(file);
  return scene;
}

void measure(benchmark::State& state, Scene scene, double element_steps, int threads) {
  const Simulation sample(scene, {});
  const double dt = 0.5 * sample.critical_dt();
  const auto elements = static_cast<double>(sample.element_count());
  scene.time.dt = dt;
  scene.output.history = std::ceil(element_steps / elements) * dt;
  Simulation simulation(scene, {.threads = threads});
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
  const auto add_large = [](const char* name, const auto& scene) {
    for (const int threads : {1, 2}) {
      benchmark::RegisterBenchmark(
          fmt::format("{}/threads:{}", name, threads).c_str(),
          [scene, threads](benchmark::State& state) { measure(state, scene(), of_large_bodies, threads); })
          ->Iterations(5)
          ->UseRealTime()
          ->Unit(benchmark::kMillisecond);
    }
  };
  // As many triangles as make 1e6 of them cover the square.
  add_large("lattice/1e6", [] {
    return scene_of_text(square(std::sqrt(1e-4 * 4 / std::sqrt(3.0)), "linear_elastic", "merge"));
  });
  add_large("mesh/1e6", [] { return meshed_square(707); });
  for (const double size : {1.0, 0.3, 0.1}) {
    for (const char* material : {"linear_elastic", "hypoelastic"}) {
      for (const char* slivers : {"merge", "mass_scale"}) {
        benchmark::RegisterBenchmark(fmt::format("lattice/{}/{}/{}", size, material, slivers).c_str(),
                                     [text = square(size, material, slivers)](benchmark::State& state) {
                                       measure(state, scene_of_text(text), element_steps_per_iteration, 1);
                                     })
            ->Iterations(5)
            ->UseRealTime()
            ->Unit(benchmark::kMillisecond);
      }
    }
  }
}

}  // namespace talus::benchmarks
