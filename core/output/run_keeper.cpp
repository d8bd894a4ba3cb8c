#include "output/run_keeper.hpp"

#include "files/whole_file.hpp"

#include <utility>

namespace talus {
namespace {

constexpr double share_of_remembering = 0.02;

/// All of settling comes before t = 0.
std::pair<bool, double> place_of(const Checkpoint& checkpoint) {
  return {!checkpoint.settling, checkpoint.time};
}

}  // namespace

RunKeeper::RunKeeper(const RunOrder& order, Simulation& simulation, Recorder& recorder, RunResult& result)
    : order_(order), simulation_(simulation), recorder_(recorder), result_(result) {}

std::string RunKeeper::state() {
  Archive archive(remembered_.state.size());
  exchange(archive);
  return archive.take_bytes();
}

void RunKeeper::restore(const Checkpoint& checkpoint) {
  Archive archive(checkpoint.state);
  exchange(archive);
  if (!archive.at_end()) Archive::refuse();
  if (!order_.checkpoints) return;
  remembered_ = order_.checkpoints->run;
  note(remembered_);
  remembered_.state = checkpoint.state;
}

/// The simulation comes first, for those who want nothing else.
void RunKeeper::exchange(Archive& archive) {
  simulation_.exchange(archive);
  recorder_.exchange(archive);
  archive(result_.settling);
  archive(result_.stepping);
  archive(result_.writing);
}

bool RunKeeper::due() const {
  return order_.checkpoints && order_.checkpoints->every &&
         wall() >= last_written_ + *order_.checkpoints->every;
}

bool RunKeeper::out_of_wall_time() const {
  return order_.checkpoints && order_.checkpoints->wall_time && wall() >= *order_.checkpoints->wall_time;
}

void RunKeeper::note(Checkpoint& checkpoint) const {
  checkpoint.model_hash = simulation_.model_hash();
  checkpoint.time = simulation_.time();
  checkpoint.settling = !simulation_.started();
  checkpoint.steps = simulation_.summary().steps;
}

void RunKeeper::write(const std::string& reason) {
  if (!order_.checkpoints) return;
  Checkpoint now = order_.checkpoints->run;
  note(now);
  now.state = state();
  put(now, reason);
  if (remembered_.state.empty()) remembered_ = std::move(now);  // until one is found good
  last_written_ = wall();
}

void RunKeeper::remember() {
  if (!order_.checkpoints || remembering_ > share_of_remembering * wall()) return;
  const double before = wall();
  if (remembered_.state.empty()) remembered_ = order_.checkpoints->run;
  note(remembered_);
  remembered_.state = state();
  remembering_ += wall() - before;
}

void RunKeeper::write_remembered(const std::string& reason) {
  if (!remembered_.state.empty()) put(remembered_, reason);
}

void RunKeeper::write_latest(const std::string& reason) {
  if (result_.checkpoint.empty() || written_ < place_of(remembered_)) write_remembered(reason);
}

void RunKeeper::put(Checkpoint& checkpoint, const std::string& reason) {
  checkpoint.reason = reason;
  const std::filesystem::path file = order_.folder / checkpoint_name;
  recorder_.flush_to_disk();
  write_checkpoint(file, checkpoint);
  result_.checkpoint = file;
  result_.checkpoint_time = checkpoint.time;
  written_ = place_of(checkpoint);
}

void RunKeeper::drop() {
  if (!order_.checkpoints) return;
  std::error_code kept;  // a folder that nothing can be removed from spoils no results
  const std::filesystem::path file = order_.folder / checkpoint_name;
  std::filesystem::remove(file, kept);
  for (const std::filesystem::path& left : temporaries_of(file)) std::filesystem::remove(left, kept);
  result_.checkpoint.clear();
}

}  // namespace talus
