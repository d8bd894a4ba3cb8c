#pragma once

#include "checkpoint/checkpoint.hpp"
#include "machine/stopwatch.hpp"
#include "output/series.hpp"
#include "scene/read.hpp"
#include "simulation/simulation.hpp"

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace talus {

enum class RunEnd {
  finished,
  interrupted,  ///< by the user, or at the end of its wall time
  stopped,      ///< by numerical trouble
};

/// When the state of a run is kept in a file: every `every` seconds of wall time, where it is interrupted,
/// and the last good one where it is stopped.
struct CheckpointOrder {
  Checkpoint run;                   ///< what the run was started with
  std::optional<double> every;      ///< s
  std::optional<double> wall_time;  ///< s that the run may take before it is broken off
};

/// How a run is to be made and recorded.
struct RunOrder {
  std::filesystem::path folder;  ///< prepared already
  std::vector<Override> overrides;
  std::string scene_hash;  ///< XXH3-128 of the scene file's bytes
  RunSettings settings;
  CpuClock clock = CpuClock::process;
  std::function<void(Simulation&)> before_settling, after_settling;  ///< called even if nothing settles
  const std::atomic<bool>* interrupted = nullptr;                    ///< polled once per step
  std::function<void(double time)> progress;                         ///< called at each output time
  std::optional<CheckpointOrder> checkpoints;
  const Checkpoint* from = nullptr;  ///< goes on from there, with files as they were then
};

/// What came out of a run.
struct RunResult {
  RunEnd end = RunEnd::finished;
  std::string trouble;               ///< words, where it was stopped
  std::filesystem::path checkpoint;  ///< the last one written, if any
  double checkpoint_time = 0;        ///< s, its t
  bool out_of_wall_time = false;
  double time = 0;             ///< s, how far it came
  bool never_settled = false;  ///< it ended before t = 0: the times above are of settling
  Series history;              ///< the rows of history.csv
  Elapsed settling, stepping, writing;
  double block_steps_per_second = 0;  ///< of wall time in the steps
  std::size_t blocks = 0, elements = 0;
  RunSummary summary;
  EnergyLedger ledger;
  std::string state_hash;

  /// Of the run, or of settling where it came no further.
  std::uint64_t steps() const { return never_settled ? summary.settle_steps : summary.steps; }
  Elapsed in_steps() const { return never_settled ? settling : stepping; }
};

/// "t = 0.5 s", and whether that is of settling.
std::string time_in_words(const RunResult& result, double time);

/// Settles, runs to the end and writes history.csv, frames, resolved.json and run.json on the way. Numerical
/// trouble and an interruption end the run with all files whole and the last state in them.
RunResult record_run(Simulation& simulation, const RunOrder& order);

}  // namespace talus
