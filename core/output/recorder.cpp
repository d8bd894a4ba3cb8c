#include "output/recorder.hpp"

#include "files/input_error.hpp"
#include "files/whole_file.hpp"
#include "output/output_folder.hpp"

#include <fmt/format.h>

#include <cmath>

namespace talus {
namespace {

constexpr const char *history_name = "history.csv", *energy_name = "energy.csv";

}  // namespace

void refuse_other_files(const Simulation& simulation, const std::filesystem::path& folder) {
  // A run that finishes takes its checkpoint away.
  if (holds_finished_run(folder)) {
    throw InputError(fmt::format(
        "'{}' is of a run that finished: the checkpoint beside it is of another, and to go on from "
        "it would spoil the results; put it into a folder of its own",
        (folder / "run.json").string()));
  }
  HistoryWriter::refuse_other(folder / history_name, monitor_columns(simulation.scene()));
  HistoryWriter::refuse_other(folder / energy_name, energy_columns());
}

Recorder::Recorder(const Simulation& simulation, const std::filesystem::path& folder)
    : simulation_(simulation), folder_(folder), columns_(monitor_columns(simulation.scene())) {
  if (simulation.scene().output.frames) frames_.emplace(folder, point_numbers(simulation));
  series_.names = columns_;
  series_.values.resize(columns_.size());
}

void Recorder::begin() {
  history_.emplace(folder_ / history_name, columns_);
  energy_.emplace(folder_ / energy_name, energy_columns());
}

void Recorder::exchange(Archive& archive) {
  std::uint64_t size = history_ ? history_->size() : 0, energy_size = energy_ ? energy_->size() : 0;
  std::string hash = history_ ? history_->hash() : "", energy_hash = energy_ ? energy_->hash() : "";
  archive(size);
  archive(hash);
  archive(energy_size);
  archive(energy_hash);
  archive(last_frame_);
  if (archive.reading()) {  // before anything is cut off or written
    HistoryWriter::refuse_changed(folder_ / history_name, size, hash);
    HistoryWriter::refuse_changed(folder_ / energy_name, energy_size, energy_hash);
  }
  if (frames_) frames_->exchange(archive);
  if (!archive.reading()) return;
  history_.emplace(folder_ / history_name, size);
  energy_.emplace(folder_ / energy_name, energy_size);
  series_ = read_series(folder_ / history_name);
}

void Recorder::record_due() {
  if (simulation_.history_due()) record_row();
  if (frames_ && simulation_.frame_due()) record_frame(sample_frame(simulation_));
}

void Recorder::record_last() {
  record_row();
  if (!frames_) return;
  const Frame frame = sample_frame(simulation_);
  if (frame.finite()) record_frame(frame);
}

void Recorder::flush_to_disk() {
  for (const char* name : {"resolved.json", history_name, energy_name}) talus::flush_to_disk(folder_ / name);
  if (frames_) frames_->flush_to_disk();
}

void Recorder::record_row() {
  const double time = simulation_.time();
  if (!(series_.time.empty() ? std::isfinite(time) : time > series_.time.back())) return;
  const std::vector<double> values = sample_monitors(simulation_);
  history_->add(time, values);
  energy_->add(time, energies(simulation_.ledger()));
  series_.time.push_back(time);
  for (std::size_t i = 0; i < values.size(); ++i) series_.values[i].push_back(values[i]);
}

void Recorder::record_frame(const Frame& frame) {
  if (!(frame.time > last_frame_)) return;
  frames_->add(frame);
  last_frame_ = frame.time;
}

}  // namespace talus
