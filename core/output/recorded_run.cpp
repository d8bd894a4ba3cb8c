#include "output/recorded_run.hpp"

#include "files/folder_lock.hpp"
#include "files/whole_file.hpp"
#include "output/recorder.hpp"
#include "output/run_keeper.hpp"
#include "output/run_record.hpp"

#include <fmt/format.h>

#include <system_error>

namespace talus {

namespace {

bool wants_to_stop(const RunOrder& order) {
  return order.interrupted != nullptr && *order.interrupted;
}

/// A run on its way.
struct Course {
  Simulation& simulation;
  const RunOrder& order;
  Recorder& recorder;
  RunKeeper& keeper;
  RunResult& result;

  Pause pause() const {
    return [this] { return wants_to_stop(order) || keeper.due() || keeper.out_of_wall_time(); };
  }
  /// Whether the run goes on after a pause.
  bool goes_on() const {
    result.out_of_wall_time = keeper.out_of_wall_time();
    if (wants_to_stop(order) || result.out_of_wall_time) {
      result.end = RunEnd::interrupted;
      keeper.write(result.out_of_wall_time ? "the wall time was over" : "the run was interrupted");
      return false;
    }
    if (keeper.due()) keeper.write("it was time for one");
    return true;
  }
};

bool settle(const Course& course) {
  const auto& [simulation, order, recorder, keeper, result] = course;
  if (order.before_settling && order.from == nullptr) order.before_settling(simulation);
  bool on = course.goes_on(), settled = false;
  while (on && !settled) {
    {
      const Timed settling(order.clock, result.settling);
      settled = simulation.settle(course.pause());
    }
    on = course.goes_on();
  }
  if (settled && order.after_settling) order.after_settling(simulation);
  return on;
}

void step_to_the_end(const Course& course) {
  const auto& [simulation, order, recorder, keeper, result] = course;
  do {
    {
      const Timed stepping(order.clock, result.stepping);
      if (!simulation.advance(course.pause())) return;
    }
    if (!simulation.history_due()) continue;
    {
      const Timed writing(order.clock, result.writing);
      recorder.record_due();
      keeper.remember();
    }
    if (order.progress) order.progress(simulation.time());
    if (!(simulation.time() < simulation.scene().time.end)) return;
  } while (course.goes_on());
}

/// The reason comes at the end, where the words of a system_error that is made of these have it once more.
std::string without_reason(const std::system_error& failure) {
  const std::string words = failure.what();
  return words.substr(0, words.rfind(": " + failure.code().message()));
}

std::string words_of_kept_state(const RunResult& result) {
  return result.checkpoint.empty()
             ? ""
             : fmt::format("; '{}' holds the state at t = {:.6g} s, from which `talus resume` goes on",
                           result.checkpoint.string(), result.checkpoint_time);
}

/// Where a file cannot be written, the disk is full perhaps: a state is small, and the time that it took is
/// not.
[[noreturn]] void keep_what_there_is(RunKeeper& keeper, const RunResult& result,
                                     const std::system_error& failure) {
  const std::string reason = failure.what();
  try {
    keeper.write_latest(reason);
  } catch (const std::system_error&) {
    // then an older one may be there
  }
  if (result.checkpoint.empty()) throw failure;
  throw std::system_error(failure.code(), fmt::format("{}{}: the reason is", without_reason(failure),
                                                      words_of_kept_state(result)));
}

/// The state at which a run ended, and its record.
void conclude(Simulation& simulation, const RunOrder& order, Recorder& recorder, RunResult& result) {
  // Of a step that nobody was to look at, stresses and contacts are those of an earlier one.
  if (result.end != RunEnd::finished && simulation.started() && simulation.look_now()) recorder.record_last();
  result.time = simulation.time();
  result.never_settled = simulation.scene().settle.has_value() && !simulation.started();
  result.history = recorder.take_series();
  result.history.stopped = result.end == RunEnd::stopped;
  result.blocks = simulation.block_count();
  result.elements = simulation.element_count();
  result.summary = simulation.summary();
  result.ledger = simulation.ledger();
  result.state_hash = simulation.state_hash();
  const double wall = result.in_steps().wall;
  if (wall > 0) {
    result.block_steps_per_second =
        static_cast<double>(result.blocks) * static_cast<double>(result.steps()) / wall;
  }
  write_whole_file(order.folder / "run.json", run_record(simulation.scene(), order, result));
}

}  // namespace

std::string time_in_words(const RunResult& result, double time) {
  return fmt::format("t = {:.6g} s{}", time, result.never_settled ? " of settling" : "");
}

RunResult record_run(Simulation& simulation, const RunOrder& order) {
  RunResult result;
  const FolderLock mine(order.folder);
  if (order.from != nullptr) refuse_other_files(simulation, order.folder);
  const auto write_scene = [&] {
    write_whole_file(order.folder / "resolved.json", simulation.scene().resolved + "\n");
  };
  if (order.from == nullptr) write_scene();
  Recorder recorder(simulation, order.folder);
  RunKeeper keeper(order, simulation, recorder, result);
  if (order.from != nullptr) {
    keeper.restore(*order.from);
    write_scene();  // once the files beside it are found to be those of the run
  } else {
    recorder.begin();
  }
  try {
    const Course course{simulation, order, recorder, keeper, result};
    if (settle(course)) step_to_the_end(course);
  } catch (const NumericalTrouble& trouble) {
    result.end = RunEnd::stopped;
    result.trouble =
        simulation.started() ? trouble.what() : fmt::format("while settling: {}", trouble.what());
    try {
      keeper.write_remembered("the last good state; then " + result.trouble);
    } catch (const std::system_error& failure) {
      result.trouble += fmt::format("; the last good state could not be kept: {}", failure.what());
    }
  } catch (const std::system_error& failure) {
    keep_what_there_is(keeper, result, failure);
  }
  try {
    conclude(simulation, order, recorder, result);
  } catch (const std::system_error& failure) {
    if (result.trouble.empty()) throw;
    throw std::system_error(failure.code(),
                            fmt::format("{}{}; what is left could not be written: {}", result.trouble,
                                        words_of_kept_state(result), without_reason(failure)));
  }
  if (result.end == RunEnd::finished) keeper.drop();
  return result;
}

}  // namespace talus
