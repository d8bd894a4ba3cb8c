#pragma once

#include "output/frame.hpp"
#include "output/history.hpp"
#include "output/series.hpp"
#include "simulation/simulation.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace talus {

/// Throws InputError where the files of a folder are not those of this run, which would be spoiled by it.
void refuse_other_files(const Simulation& simulation, const std::filesystem::path& folder);

/// Writes rows and frames of a run as they fall due, each time once: history.csv has the monitors, energy.csv
/// the ledger.
class Recorder {
 public:
  Recorder(const Simulation& simulation, const std::filesystem::path& folder);

  void begin();  ///< with empty files
  /// What was written so far. Taken out of an archive, files lose all that came later and are gone on with;
  /// throws InputError where they are not as they were left.
  void exchange(Archive& archive);

  void record_due();
  /// The state at which a run was broken off. Positions that are no numbers would spoil the picture.
  void record_last();

  /// What a checkpoint counts on outlives a failure of the power as it does.
  void flush_to_disk();

  Series take_series() { return std::move(series_); }

 private:
  void record_row();
  void record_frame(const Frame& frame);

  const Simulation& simulation_;
  std::filesystem::path folder_;
  std::vector<std::string> columns_;
  std::optional<HistoryWriter> history_, energy_;
  std::optional<FrameWriter> frames_;
  double last_frame_ = -1;  ///< s
  Series series_;
};

}  // namespace talus
