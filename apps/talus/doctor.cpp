#include "arguments.hpp"
#include "commands.hpp"
#include "diagnosis/diagnosis.hpp"
#include "exit_code.hpp"
#include "files/input_error.hpp"
#include "kept_run.hpp"
#include "output/records.hpp"
#include "output/series.hpp"
#include "scene_options.hpp"
#include "text/shell_word.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace talus {

namespace {

namespace po = boost::program_options;

constexpr std::size_t most_steps = 200000;
constexpr double noticed = 0.01;  ///< share of the throughput

/// Where the ledger first missed more than can be passed over, from energy.csv; of a run that is stopped
/// between two rows the largest share of all may be in the record alone.
void say_when_energy_was_lost(const std::filesystem::path& folder, double largest_of_all) {
  const Series series = read_series(folder / "energy.csv");
  const auto residual = series.column("residual [J/m]"), throughput = series.column("throughput [J/m]");
  if (!residual || !throughput)
    throw InputError(fmt::format("'{}' has no ledger", (folder / "energy.csv").string()));
  double largest = 0, at = 0;
  for (std::size_t i = 0; i < series.time.size(); ++i) {
    const double share = series.values[*throughput][i] > 0
                             ? std::abs(series.values[*residual][i]) / series.values[*throughput][i]
                             : 0;
    if (share > noticed && largest <= noticed) {
      fmt::print("the energy balance first misses more than {:.0f} % of the throughput by t = {:.6g} s\n",
                 100 * noticed, series.time[i]);
    }
    if (share > largest) largest = share, at = series.time[i];
  }
  if (largest_of_all > largest * (1 + 1e-6)) {
    fmt::print("the energy balance misses {:.3g} % of the throughput at most, when the run was stopped\n",
               100 * largest_of_all);
    return;
  }
  fmt::print("the energy balance misses {:.3g} % of the throughput at most, at t = {:.6g} s\n", 100 * largest,
             at);
}

/// How the run ended. Returns its record, which says so.
nlohmann::ordered_json tell_end(const std::filesystem::path& folder) {
  for (const char* of_many : {"compare.json", "study.json"}) {
    if (std::filesystem::exists(folder / of_many))
      throw InputError(fmt::format("'{}' holds several runs: name the folder of one in it", folder.string()));
  }
  if (std::filesystem::exists(folder) && !std::filesystem::is_directory(folder))
    throw InputError(fmt::format("'{}' is no folder of results", folder.string()));
  if (!std::filesystem::exists(folder / "run.json") && std::filesystem::exists(checkpoint_file(folder)))
    throw InputError(fmt::format(
        "'{}' holds a run that was broken off before it could be recorded: `talus resume {}` goes "
        "on with it from its checkpoint",
        folder.string(), shell_word(folder.string())));
  auto record = read_run_record(folder);
  const bool settled = !record.contains("settling_t [s]");
  fmt::print("{}: {} at t = {:.9g} s{} after {} steps\n", folder.string(),
             record.at("end").get<std::string>(),
             record.at(settled ? "t [s]" : "settling_t [s]").get<double>(), settled ? "" : " of settling",
             record.at(settled ? "steps" : "settle_steps").dump());
  if (record.contains("trouble")) fmt::print("{}\n", record.at("trouble").get<std::string>());
  for (const auto& warning : record.at("warnings")) fmt::print("warned: {}\n", warning.get<std::string>());
  return record;
}

/// There is a good state from t = 0 on, where it is kept.
void say_why_no_state(const nlohmann::ordered_json& record) {
  fmt::print(
      "there is no checkpoint to go through the end again: {}\n",
      record.contains("settling_t [s]")
          ? "it was stopped before t = 0"
          : "`compare`, `study` and scenes from a pipe keep none, `talus run` does with the scene in a "
            "file and the same --set");
}

}  // namespace

Usage usage_of_doctor() {
  Usage usage{
      "doctor", "FOLDER",
      "Explains a run that was stopped or whose energy does not balance: goes through it again step by step\n"
      "from its last good state, and says which step, which contact and what to change.",
      "FOLDER", "  talus doctor out/column\n"};
  usage.options.add_options()("plugin-path", po::value<std::vector<std::string>>()->value_name("DIR"),
                              "look for plugins here before the folders that the run was started with");
  add_allow_plugins(usage);
  return usage;
}

int doctor_command(const Words& words) {
  const Usage usage = usage_of_doctor();
  const auto given = read_arguments(usage, words);
  if (!given) return exit_code::ok;
  const std::filesystem::path folder = text_option(*given, "FOLDER");
  if (folder.empty()) throw UsageError(usage.command, "FOLDER is empty");
  const auto record = tell_end(folder);
  say_when_energy_was_lost(folder, record.at("largest_residual_share").get<double>());
  const std::filesystem::path file = checkpoint_file(folder);
  if (record.at("end") != "stopped") return exit_code::ok;
  if (!std::filesystem::exists(file)) {
    say_why_no_state(record);
    return exit_code::ok;
  }
  const Checkpoint checkpoint = read_checkpoint(file);
  KeptRun kept(checkpoint, {.threads = checkpoint.threads, .neighbour_skin = checkpoint.neighbour_skin},
               plugin_folders_of(usage, *given), given->count("allow-plugins") != 0);
  Archive archive(checkpoint.state);
  kept.simulation.exchange(archive);
  fmt::print("\nagain from the last good state, t = {:.9g} s:\n", checkpoint.time);
  fmt::print("{}", diagnosis_text(kept.simulation.scene(), diagnose(kept.simulation, most_steps)));
  return exit_code::ok;
}

}  // namespace talus
