#include "whole_program.hpp"

#include "step.hpp"

#include <benchmark/benchmark.h>

#include <fmt/format.h>

#include <sys/resource.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace talus::benchmarks {
namespace {

struct Program {
  std::string name, scene, options;
  double end;  ///< s
};

/// Processor time of all children that have ended, s.
double time_of_children() {
  rusage used{};
  getrusage(RUSAGE_CHILDREN, &used);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

void measure(benchmark::State& state, const Program& program, int threads) {
  std::string folder = (std::filesystem::temp_directory_path() / "talus-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) {
    state.SkipWithError("no folder for the results");
    return;
  }
  const std::string command =
      fmt::format("'{}' run '{}' --set /time/end={} --threads {} --out '{}/run' {} > '{}/log' 2>&1",
                  TALUS_PROGRAM, program.scene, program.end, threads, folder, program.options, folder);
  double used = 0;
  for (auto iteration : state) {
    (void)iteration;
    std::filesystem::remove_all(folder + "/run");
    const double before = time_of_children();
    if (std::system(command.c_str()) != 0) {
      state.SkipWithError(("failed: " + command).c_str());
      break;
    }
    const double cpu = time_of_children() - before;
    used += cpu;
    state.SetIterationTime(cpu);
  }
  std::filesystem::remove_all(folder);
  state.counters["cpu_s_per_simulated_s"] = used / static_cast<double>(state.iterations()) / program.end;
}

}  // namespace

void register_whole_programs() {
  const std::string scenes = TALUS_SCENES, rigid = R"(--set '/cover/model=rigid')",
                    sleep = R"(--set '/sleep={}')";
  const std::vector<Program> programs{
      {"brick_wall/411/block", scenes + "/brick_wall.json", "", 1},
      {"brick_wall/411/rigid", scenes + "/brick_wall.json", rigid, 1},
      {"brick_wall/411/block/sleep", scenes + "/brick_wall.json", sleep, 1},
      {"brick_wall/411/rigid/sleep", scenes + "/brick_wall.json", rigid + " " + sleep, 1},
      {"vaiont", scenes + "/vaiont.json", "", 35},
  };
  for (const Program& program : programs) {
    for (const int threads : {1, 2}) {
      benchmark::RegisterBenchmark(
          fmt::format("{}whole_program/{}/threads:{}", large, program.name, threads).c_str(),
          [program, threads](benchmark::State& state) { measure(state, program, threads); })
          ->Iterations(1)
          ->UseManualTime()
          ->Unit(benchmark::kSecond);
    }
  }
}

}  // namespace talus::benchmarks
