#pragma once

#include "output/series.hpp"
#include "study/plan.hpp"

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace talus {

/// One run of a study as its folder tells it.
struct StudyRun {
  std::filesystem::path folder;
  bool done = false;    ///< run to its end, or stopped by numerical trouble
  std::string end;      ///< "finished", "stopped", or "refused" where the scene is none with these values
  std::string trouble;  ///< words, unless finished
  double dt = 0;        ///< s, the largest step
  double cpu = 0;  ///< s, in the steps, settling included; the median where the run was made several times
  std::vector<double> cpu_of_each;  ///< s, of each time
  double work = 0;                  ///< steps times elements and blocks
  double residual = 0;              ///< share of the energy throughput that the ledger missed, at most
  double penetration = 0;           ///< m, the largest
  std::vector<std::string> warnings;
  Series history;
};

/// A scene with the registry that it points into.
struct HeldScene {
  std::unique_ptr<Registry> registry;
  Scene scene;
};

struct StudyOrder {
  std::filesystem::path folder;
  StudyPlan plan;
  std::vector<Override> overrides;  ///< common to all runs
  std::string scene_hash;
  SimdLevel simd = SimdLevel::scalar;
  int threads = 1;                  ///< runs at a time, one thread each
  std::filesystem::path reference;  ///< that no run may replace; empty: none
  bool overwrite = false;           ///< what the folder holds of other studies
  int times = 1;  ///< that each run is made, all of them in turn, for the median of their cost
  /// Reads the scene with overrides; throws SceneError. Never called twice at a time.
  std::function<HeldScene(const std::vector<Override>&)> read;
  const std::atomic<bool>* interrupted = nullptr;
  std::function<void(std::size_t done, std::size_t all)> progress;  ///< never called twice at a time
};

/// Makes all runs, each in a folder of its own; those that the folder holds already, of the same scene and
/// libraries with the same values, are taken as they are; of others InputError, unless they may be
/// overwritten. In the order of the plan.
std::vector<StudyRun> make_runs(const StudyOrder& order);

bool finished(const StudyRun& run);

/// The numbers of the runs, the cheapest first.
std::vector<std::size_t> by_cost(const std::vector<StudyRun>& runs);

}  // namespace talus
