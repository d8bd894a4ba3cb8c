#include "output/recorded_run.hpp"

#include "output/frame.hpp"
#include "output/history.hpp"
#include "output/run_record.hpp"
#include "output/whole_file.hpp"

#include <cmath>
#include <optional>

namespace talus {

namespace {

/// Writes rows and frames as they fall due, each time once.
class Recorder {
 public:
  Recorder(const Simulation& simulation, const std::filesystem::path& folder)
      : simulation_(simulation),
        columns_(monitor_columns(simulation.scene())),
        history_(folder / "history.csv", columns_) {
    if (simulation.scene().output.frames) frames_.emplace(folder);
    series_.names = columns_;
    series_.values.resize(columns_.size());
  }

  void record_due() {
    if (simulation_.history_due()) record_row();
    if (frames_ && simulation_.frame_due()) record_frame();
  }

  /// The state at which a run was broken off. Positions that are no numbers would spoil the picture.
  void record_last() {
    record_row();
    if (frames_ && sample_frame(simulation_).finite()) record_frame();
  }

  Series take_series() { return std::move(series_); }

 private:
  void record_row() {
    const double time = simulation_.time();
    if (!(series_.time.empty() ? std::isfinite(time) : time > series_.time.back())) return;
    const std::vector<double> values = sample_monitors(simulation_);
    history_.add(time, values);
    series_.time.push_back(time);
    for (std::size_t i = 0; i < values.size(); ++i) series_.values[i].push_back(values[i]);
  }

  void record_frame() {
    const double time = simulation_.time();
    if (last_frame_ && !(time > *last_frame_)) return;
    frames_->add(sample_frame(simulation_));
    last_frame_ = time;
  }

  const Simulation& simulation_;
  std::vector<std::string> columns_;
  HistoryWriter history_;
  std::optional<FrameWriter> frames_;
  std::optional<double> last_frame_;
  Series series_;
};

bool wants_to_stop(const RunOrder& order) {
  return order.interrupted != nullptr && *order.interrupted;
}

void settle(Simulation& simulation, const RunOrder& order, RunResult& result) {
  if (order.before_settling) order.before_settling(simulation);
  if (!wants_to_stop(order)) {
    const Stopwatch watch(order.clock);
    simulation.settle(order.interrupted);
    result.settling += watch.elapsed();
  }
  if (order.after_settling) order.after_settling(simulation);
}

void step_to_the_end(Simulation& simulation, const RunOrder& order, Recorder& recorder, RunResult& result) {
  while (!wants_to_stop(order)) {
    const Stopwatch stepping(order.clock);
    const bool more = simulation.advance(order.interrupted);
    result.stepping += stepping.elapsed();
    if (!more) return;
    const Stopwatch writing(order.clock);
    recorder.record_due();
    result.writing += writing.elapsed();
    if (order.progress) order.progress(simulation.time());
  }
  result.end = RunEnd::interrupted;
}

}  // namespace

RunResult record_run(Simulation& simulation, const RunOrder& order) {
  RunResult result;
  write_whole_file(order.folder / "resolved.json", simulation.scene().resolved + "\n");
  Recorder recorder(simulation, order.folder);
  try {
    settle(simulation, order, result);
    step_to_the_end(simulation, order, recorder, result);
  } catch (const NumericalTrouble& trouble) {
    result.end = RunEnd::stopped;
    result.trouble = trouble.what();
  }
  if (result.end != RunEnd::finished) recorder.record_last();
  result.time = simulation.time();
  result.history = recorder.take_series();
  result.blocks = simulation.block_count();
  result.summary = simulation.summary();
  result.ledger = simulation.ledger();
  result.state_hash = simulation.state_hash();
  if (result.stepping.wall > 0) {
    result.block_steps_per_second =
        static_cast<double>(result.blocks) * static_cast<double>(result.summary.steps) / result.stepping.wall;
  }
  write_whole_file(order.folder / "run.json", run_record(simulation.scene(), order, result));
  return result;
}

}  // namespace talus
