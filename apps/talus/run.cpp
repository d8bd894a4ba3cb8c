#include "commands.hpp"
#include "exit_code.hpp"
#include "interrupt.hpp"
#include "output/hash.hpp"
#include "output/output_folder.hpp"
#include "output/recorded_run.hpp"
#include "output/run_record.hpp"
#include "progress.hpp"
#include "scene_options.hpp"
#include "terminal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace talus {

namespace {

namespace po = boost::program_options;

Usage usage_of_run() {
  Usage usage{"run", "SCENE [options]",
              "Runs a scene and writes history.csv, frames.pvd with frames/ (if the scene asks for frames),\n"
              "resolved.json and run.json to a folder: out/<scene name> unless --out says otherwise.",
              "SCENE",
              "  talus run scenes/incline.json --set /time/end=3 --out out/incline-3s\n"
              "  talus run scenes/brick_wall.json --threads 2 --overwrite\n"};
  usage.options.add_options()("out", po::value<std::string>()->value_name("DIR"),
                              "folder for the results (default: out/<scene name>)")(
      "overwrite", "replace results that the folder holds already")(
      "threads", po::value<int>()->value_name("N"), "threads to use (default: 1; same bits for any number)");
  add_scene_options(usage);
  usage.options.add_options()("profile", "say at the end what each part of the steps took");
  usage.options.add_options()("quiet,q", "no progress and no summary")(
      "no-skin", "seek contact candidates anew at every step: slow, for checking; the bits stay the same");
  return usage;
}

void print_summary(const RunResult& result, const std::filesystem::path& folder) {
  const RunSummary& summary = result.summary;
  fmt::print("{} at t = {:.6g} s: {} steps of at most {:.6g} s", name_of(result.end), result.time,
             summary.steps, summary.dt);
  if (!summary.dt_limiter.empty()) fmt::print(" ({})", summary.dt_limiter);
  fmt::print("\n{:.3f} s in the steps, {:.3g} block-steps per second\n", result.stepping.wall,
             result.block_steps_per_second);
  if (summary.largest_penetration > 0) {
    fmt::print("largest overlap {:.4g} m ({})\n", summary.largest_penetration,
               summary.largest_penetration_pair);
  }
  if (summary.sleep) {
    const SleepReport& sleep = *summary.sleep;
    fmt::print(
        "islands that slept: {}, that woke: {}; bodies asleep at the end: {}; longest sleep {:.4g} s\n",
        sleep.islands, sleep.woken, sleep.bodies_asleep, sleep.longest);
    fmt::print(
        "not followed: corners of {:.3g} m/s and {:.3g} m/s2, so up to {:.3g} m/s and {:.3g} m; "
        "{:.3g} J/m taken\n",
        sleep.speed, sleep.acceleration, sleep.velocity_bound, sleep.displacement_bound,
        sleep.kinetic_energy);
  }
  fmt::print("largest energy residual {:.2g} % of the throughput\nstate {}\nresults in {}\n",
             100 * summary.largest_residual_share, result.state_hash, folder.string());
}

/// Time of each part of the steps, settling included.
void print_profile(const RunSummary& summary, std::size_t blocks) {
  double total = 0;
  for (const double seconds : summary.profile.seconds()) total += seconds;
  const double steps = static_cast<double>(summary.steps + summary.settle_steps);
  fmt::print("{:<12}{:>12}{:>9}{:>22}\n", "part", "time [s]", "share", "per block-step [ns]");
  for (std::size_t i = 0; i < phase_count; ++i) {
    const double seconds = summary.profile.seconds()[i];
    fmt::print(
        "{:<12}{:>12.4f}{:>8.1f}%{:>22.1f}\n", name_of(static_cast<Phase>(i)), seconds,
        total > 0 ? 100 * seconds / total : 0.0,
        1e9 * seconds / (std::max(steps, 1.0) * static_cast<double>(std::max<std::size_t>(blocks, 1))));
  }
}

int code_of(const RunResult& result) {
  switch (result.end) {
    case RunEnd::finished:
      return exit_code::ok;
    case RunEnd::stopped:
      return exit_code::numerical_trouble;
    case RunEnd::interrupted:
      return exit_code::interrupted;
  }
  return exit_code::internal_error;
}

}  // namespace

int run_command(const Words& words) {
  const Usage usage = usage_of_run();
  const auto given = read_arguments(usage, words);
  if (!given) return exit_code::ok;
  const std::filesystem::path file = text_option(*given, "SCENE");
  const bool quiet = given->count("quiet") != 0;

  RunOrder order;
  order.overrides = overrides_of(usage, *given);
  order.settings.threads = threads_of(usage, *given, 1);
  order.settings.profile = given->count("profile") != 0;
  order.settings.neighbour_skin = given->count("no-skin") == 0;
  const std::string out = text_option(*given, "out");
  order.folder = out.empty() ? std::filesystem::path("out") / file.stem() : std::filesystem::path(out);

  Registry registry = load_registry(usage, *given);
  Scene read = read_scene_of(file, registry, order.overrides, given->count("allow-plugins") != 0);
  for (const std::string& warning : read.warnings) print_warning(warning);
  order.scene_hash = hash_of_file(file);
  Simulation simulation(std::move(read), order.settings);
  const Scene& scene = simulation.scene();
  prepare_output_folder(order.folder, given->count("overwrite") != 0);

  order.interrupted = watch_for_interrupts();
  Progress progress(quiet);
  if (scene.settle) progress.show(0, "settling");
  order.progress = [&](double time) {
    progress.show(time / scene.time.end, fmt::format("t = {:.4g} of {:.4g} s", time, scene.time.end));
  };
  const RunResult result = record_run(simulation, order);
  progress.clear();

  for (const std::string& warning : result.summary.warnings) print_warning(warning);
  if (result.end == RunEnd::stopped) print_error(result.trouble);
  if (result.end == RunEnd::interrupted) {
    fmt::print(stderr, "interrupted at t = {:.6g} s; results so far are in {}\n", result.time,
               order.folder.string());
  }
  if (!quiet) print_summary(result, order.folder);
  if (result.summary.profile.on()) print_profile(result.summary, result.blocks);
  return code_of(result);
}

}  // namespace talus
