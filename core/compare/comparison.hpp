#pragma once

#include "compare/deviation.hpp"
#include "compare/variation.hpp"
#include "output/recorded_run.hpp"

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace talus {

struct ReferenceFile {
  std::string file;
  std::string hash;  ///< XXH3-128 of its bytes
  Series series;
  std::string text{};  ///< of the file, for a copy
};

/// What is to be compared: one scene per value of the variation, the first one the baseline.
struct ComparisonOrder {
  std::filesystem::path folder;  ///< for the runs prepared already, and so are its subfolders
  Variation variation;
  std::vector<Scene> scenes;        ///< [value]
  std::vector<Override> overrides;  ///< common to all
  std::string scene_hash;
  int threads = 1;  ///< runs at a time; each run has one thread
  bool neighbour_skin = true;
  std::optional<ReferenceFile> reference;
  std::vector<double> moments;  ///< s, times at which deviations are asked for
  const std::atomic<bool>* interrupted = nullptr;
  std::function<void(double share)> progress;  ///< of all runs together; never two calls at a time
};

struct ComparedRun {
  std::string value;
  double own_dt = 0;                ///< s, the automatic step this run would have chosen alone
  double critical_dt = 0;           ///< s, bound at its start, whoever meets whom
  std::optional<double> own_steps;  ///< how many of them it would have made; none where that is not known
  std::optional<double> settled_difference;  ///< m, largest distance of a vertex from the baseline's at t = 0
  RunResult result;
};

/// Deviation of one column of one run.
struct ColumnDeviation {
  std::string column;
  std::size_t run;
  bool from_reference;  ///< else from the baseline
  Deviation deviation;
  std::vector<std::optional<double>> at_moments;
};

struct ComparedTolerance {
  Tolerance tolerance;
  std::size_t run;
  std::vector<ToleranceCheck> checks;  ///< empty where there was nothing to compare
};

struct Comparison {
  std::vector<ComparedRun> runs;    ///< [value]
  std::optional<double> common_dt;  ///< s, the step that the scene states, or the largest for all; none where
                                    ///< the time settings vary
  std::vector<ColumnDeviation> deviations;
  std::vector<ComparedTolerance> tolerances;
  std::vector<std::string> warnings;

  bool tolerances_held() const;
};

/// Throws InputError when nothing could be compared: too few values, no monitor, no common column.
void check_order(const ComparisonOrder& order);

/// A comparison before its runs, with the step that all will take. Checks the order, and makes a simulation
/// of each scene for once: what is wrong with one is found before anything is written.
Comparison planned(const ComparisonOrder& order);

/// Runs the scenes side by side from the same settled geometry, and evaluates them.
void compare(const ComparisonOrder& order, Comparison& comparison);

/// The evaluation alone, of runs that were made: fills in deviations and tolerances.
void evaluate(const ComparisonOrder& order, Comparison& comparison);

}  // namespace talus
