#include "running.hpp"

#include "exit_code.hpp"
#include "interrupt.hpp"
#include "output/run_record.hpp"
#include "progress.hpp"
#include "report/report.hpp"
#include "text/shell_word.hpp"

#include <fmt/format.h>

#include <utility>

namespace talus {
namespace {

namespace po = boost::program_options;

std::optional<double> seconds_of(const Usage& usage, const po::variables_map& given, const char* name) {
  if (given.count(name) == 0) return std::nullopt;
  const double seconds = given[name].as<double>();
  if (!(seconds >= 0)) {
    throw UsageError(usage.command, fmt::format("--{} {}: give seconds, 0 or more", name, seconds));
  }
  return seconds;
}

void print_summary(const RunResult& result, const std::filesystem::path& folder) {
  const RunSummary& summary = result.summary;
  fmt::print("{} at {}: {} steps of at most {:.6g} s", name_of(result.end),
             time_in_words(result, result.time), result.steps(), summary.dt);
  if (!summary.dt_limiter.empty()) fmt::print(" ({})", summary.dt_limiter);
  fmt::print("\n{:.3f} s in the steps, {:.3g} block-steps per second\n", result.in_steps().wall,
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

/// The facts of the summary, for programs.
Log::Fields facts_of(const RunResult& result, const std::filesystem::path& folder) {
  const RunSummary& summary = result.summary;
  Log::Fields facts{{"t [s]", result.time},
                    {"steps", result.steps()},
                    {"dt [s]", summary.dt},
                    {"wall [s]", result.in_steps().wall},
                    {"largest_overlap [m]", summary.largest_penetration},
                    {"largest_residual_share", summary.largest_residual_share},
                    {"state_hash", result.state_hash},
                    {"folder", folder.string()}};
  if (!result.checkpoint.empty()) facts["checkpoint"] = result.checkpoint.string();
  return facts;
}

std::string words_to_resume(const RunOrder& order) {
  const Checkpoint& run = order.checkpoints->run;
  return fmt::format("talus resume {}{}",
                     run.allow_plugins || !run.plugin_folders.empty() ? "--allow-plugins " : "",
                     shell_file(order.folder.string()));
}

void say_how_it_ended(const RunResult& result, const RunOrder& order, const Log& log) {
  const std::filesystem::path& folder = order.folder;
  if (result.end == RunEnd::stopped) log.error(result.trouble, facts_of(result, folder));
  if (log.in_json()) return;
  if (result.end == RunEnd::interrupted) {
    log.info("interrupted", fmt::format("{} at {}; results so far are in {}",
                                        result.out_of_wall_time ? "out of wall time" : "interrupted",
                                        time_in_words(result, result.time), folder.string()));
  }
  if (result.end == RunEnd::finished || result.checkpoint.empty()) return;
  log.info(
      "checkpoint",
      fmt::format("{} {} holds the state at {}",
                  result.end == RunEnd::interrupted ? fmt::format("`{}` goes on:", words_to_resume(order))
                                                    : "the last good state was kept:",
                  result.checkpoint.string(), time_in_words(result, result.checkpoint_time)));
}

}  // namespace

void add_running_options(Usage& usage) {
  usage.options.add_options()(
      "checkpoint-every", po::value<double>()->value_name("SECONDS"),
      "keep the state in checkpoint.talus again and again, after so much time on the clock")(
      "wall-time", po::value<double>()->value_name("SECONDS"),
      "stop after so much time on the clock, with the state kept as on Ctrl-C")(
      "no-report", "write no report.html")("profile", "say at the end what each part of the steps took")(
      "quiet,q", "no progress and no summary");
  add_log_options(usage);
}

void read_running_options(const Usage& usage, const po::variables_map& given, RunOrder& order) {
  order.settings.profile = given.count("profile") != 0;
  order.settings.contacts_as_recorded = true;
  if (!order.checkpoints) return;
  order.checkpoints->every = seconds_of(usage, given, "checkpoint-every");
  order.checkpoints->wall_time = seconds_of(usage, given, "wall-time");
}

int conduct(Simulation& simulation, RunOrder& order, const po::variables_map& given, const Log& log) {
  const bool quiet = given.count("quiet") != 0, report = given.count("no-report") == 0;
  const Scene& scene = simulation.scene();
  order.interrupted = watch_for_interrupts();
  log.info("started", "",
           {{"scene", scene.file},
            {"folder", order.folder.string()},
            {"end [s]", scene.time.end},
            {"threads", order.settings.threads},
            {"version", TALUS_VERSION}});
  Progress progress(log, quiet);
  if (order.from != nullptr) {
    progress.begin_at(order.from->settling ? 0 : order.from->time / scene.time.end);
  } else if (scene.settle) {
    progress.show(0, "settling");
  }
  bool settling = order.from != nullptr ? order.from->settling : scene.settle.has_value();
  order.progress = [&](double time) {
    if (std::exchange(settling, false)) progress.begin_at(time / scene.time.end);  // that took its own time
    progress.show(time / scene.time.end, fmt::format("t = {:.4g} of {:.4g} s", time, scene.time.end));
  };
  const RunResult result = record_run(simulation, order);
  progress.clear();
  if (report) write_report(order.folder);

  for (const std::string& warning : result.summary.warnings) log.warning(warning);
  say_how_it_ended(result, order, log);
  if (result.end != RunEnd::stopped && log.in_json())
    log.info(name_of(result.end), "", facts_of(result, order.folder));
  if (!quiet) print_summary(result, order.folder);
  if (result.summary.profile.on()) print_profile(result.summary, result.blocks);
  return code_of(result);
}

}  // namespace talus
