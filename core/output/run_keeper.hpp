#pragma once

#include "output/recorded_run.hpp"
#include "output/recorder.hpp"

#include <chrono>
#include <string>
#include <utility>

namespace talus {

/// Keeps the state of a run in a file beside its results, so that another run can go on from there.
class RunKeeper {
 public:
  RunKeeper(const RunOrder& order, Simulation& simulation, Recorder& recorder, RunResult& result);

  /// State and files as they were when the checkpoint was written.
  void restore(const Checkpoint& checkpoint);

  bool due() const;                       ///< for the next regular checkpoint
  bool out_of_wall_time() const;          ///< for the whole run
  void write(const std::string& reason);  ///< of the present state, which nobody has judged yet

  /// Holds the present state in memory, which was found good, at a fiftieth of the time of the run at most.
  void remember();
  void write_remembered(const std::string& reason);
  /// The same, unless a later state is in the folder already.
  void write_latest(const std::string& reason);

  /// Of a run that is at its end nothing is left to go on with.
  void drop();

 private:
  using Clock = std::chrono::steady_clock;
  double wall() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }  ///< s
  std::string state();
  void exchange(Archive& archive);
  void note(Checkpoint& checkpoint) const;
  void put(Checkpoint& checkpoint, const std::string& reason);

  const RunOrder& order_;
  Simulation& simulation_;
  Recorder& recorder_;
  RunResult& result_;
  Clock::time_point begin_ = Clock::now();
  double last_written_ = 0;                    ///< s on the clock
  double remembering_ = 0;                     ///< s on the clock that it has taken
  Checkpoint remembered_;                      ///< the last good state
  std::pair<bool, double> written_{false, 0};  ///< the state in the folder: whether of the run itself, s
};

}  // namespace talus
