#include "study/study.hpp"

#include "files/hash.hpp"
#include "files/input_error.hpp"
#include "machine/processor.hpp"
#include "output/output_folder.hpp"
#include "output/recorded_run.hpp"
#include "output/records.hpp"
#include "output/run_record.hpp"
#include "parallel/tasks.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <mutex>
#include <numeric>
#include <optional>

namespace talus {
namespace {

using Json = nlohmann::ordered_json;

Json set_of(const std::vector<Override>& overrides) {
  Json set = Json::array();
  for (const Override& change : overrides)
    set.push_back({{"pointer", change.pointer}, {"value", change.value}});
  return set;
}

/// Whether all files that a run read besides its scene are what they were.
bool files_unchanged(const Json& scene) {
  const Json files = scene.value("files", Json());
  if (!files.is_object()) return false;
  for (const auto& [file, hash] : files.items()) {
    if (!std::filesystem::is_regular_file(file) || hash_of_file(file) != hash) return false;
  }
  return true;
}

/// The same files as they are now; those that are gone have no hash.
std::map<std::string, std::string> files_now(std::map<std::string, std::string> files) {
  for (auto& [file, hash] : files)
    hash = std::filesystem::is_regular_file(file) ? hash_of_file(file) : std::string();
  return files;
}

struct StudyLibrary {
  std::string hash, opened, opened_hash;
};

std::vector<StudyLibrary> libraries_of(const Scene& scene) {
  std::vector<StudyLibrary> libraries;
  for (const UsedLibrary& used : used_libraries(scene))
    libraries.push_back({hash_of_file(used.file), used.opened.string(), hash_of_file(used.opened)});
  return libraries;
}

/// Whether a run took the libraries that its scene would take now.
/// For another instruction set, which changes no bit, others are opened.
bool same_libraries(const Json& record, const std::vector<StudyLibrary>& libraries) {
  const Json& then = record.at("plugins");
  return std::equal(then.begin(), then.end(), libraries.begin(), libraries.end(),
                    [](const Json& library, const StudyLibrary& now) {
                      return library.value("xxh3_128", Json()) == now.hash &&
                             (library.value("opened", Json()) != now.opened ||
                              library.value("opened_xxh3_128", Json()) == now.opened_hash);
                    });
}

/// Instructions and processor change no bit of a run, but its cost.
bool costs_alike(const Json& record, SimdLevel simd) {
  const Json machine = record.value("machine", Json());
  return record.at("settings").at("simd") == name_of(simd) && machine.is_object() &&
         machine.value("processor", Json()) == processor_name();
}

/// What is no number is null in JSON.
double number_or(const Json& value, double otherwise) {
  return value.is_number() ? value.get<double>() : otherwise;
}

/// Nothing where it is not all there: the run is made again.
Series history_of(const std::filesystem::path& folder, double end) {
  const std::filesystem::path file = folder / "history.csv";
  if (!std::filesystem::exists(file)) return {};
  try {
    Series history = read_series(file);
    if (!history.time.empty() && history.time.back() >= end * (1 - 1e-9)) return history;
  } catch (const InputError&) {
    return {};
  }
  return {};
}

/// Whether a run is of something else than is asked for, or of another cost.
bool of_another_study(const Json& record, const std::vector<Override>& overrides,
                      const std::string& scene_hash, SimdLevel simd) {
  return record.at("scene").at("xxh3_128") != scene_hash ||
         record.at("settings").at("set") != set_of(overrides) || !costs_alike(record, simd);
}

/// What the folder of a run tells, if it is the run that is asked for, with these libraries.
StudyRun run_in(const std::filesystem::path& folder, const std::vector<Override>& overrides,
                const std::string& scene_hash, SimdLevel simd, const std::vector<StudyLibrary>& libraries) {
  StudyRun run;
  run.folder = folder;
  const std::optional<Json> found = run_record_in(folder);
  if (!found || of_another_study(*found, overrides, scene_hash, simd)) return run;
  const Json& record = *found;
  if (record.value("talus", Json()) != TALUS_VERSION || record.at("end") == "interrupted" ||
      !files_unchanged(record.at("scene")) || !same_libraries(record, libraries))
    return run;
  run.end = record.at("end");
  run.trouble = record.value("trouble", "");
  run.dt = number_or(record.at("dt [s]"), 0);
  const Json& cost = record.at("cost");
  run.cpu = cost.at("settling").at("cpu [s]").get<double>() + cost.at("stepping").at("cpu [s]").get<double>();
  run.cpu_of_each = {run.cpu};
  run.work = (record.at("settle_steps").get<double>() + record.at("steps").get<double>()) *
             std::max(record.at("elements").get<double>(), record.at("blocks").get<double>());
  run.residual = number_or(record.at("largest_residual_share"), 1);
  run.penetration = number_or(record.at("largest_penetration [m]"), 0);
  run.warnings = record.at("warnings").get<std::vector<std::string>>();
  // Of a run that was stopped the last rows may be from before the end.
  run.history = history_of(folder, finished(run) ? record.at("t [s]").get<double>() : 0);
  run.done = !finished(run) || !run.history.time.empty();
  return run;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

/// "run_0007", and "run_0007_2" for the second time.
std::string folder_name(std::size_t run, int time) {
  return time == 0 ? fmt::format("run_{:04}", run + 1) : fmt::format("run_{:04}_{}", run + 1, time + 1);
}

class Runs {
 public:
  explicit Runs(const StudyOrder& order) : order_(order), runs_(order.plan.points.size()) {}

  std::vector<StudyRun> make() {
    if (order_.overwrite) {
      remove_other_runs();
    } else {
      refuse_other_runs();
    }
    // All runs once, then all once more: what disturbs the machine for a while disturbs one time of each.
    const std::size_t all = runs_.size() * static_cast<std::size_t>(std::max(1, order_.times));
    do_tasks(all, order_.threads, [&](std::size_t i) { make_one(i, all); });
    for (StudyRun& run : runs_) {
      if (!run.cpu_of_each.empty()) run.cpu = median(run.cpu_of_each);
    }
    return std::move(runs_);
  }

 private:
  std::vector<Override> overrides_of(std::size_t i) const {
    std::vector<Override> overrides = order_.overrides;
    for (const Override& change : order_.plan.overrides(order_.plan.points[i])) overrides.push_back(change);
    return overrides;
  }

  void refuse_other_runs() const {
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      const std::filesystem::path folder = order_.folder / folder_name(i, 0);
      const std::optional<Json> record = run_record_in(folder);
      if (record && of_another_study(*record, overrides_of(i), order_.scene_hash, order_.simd))
        throw InputError(fmt::format(
            "'{}' holds a run with other values, of another scene, or with other instructions or on another "
            "processor, whose cost tells nothing here: give --overwrite to replace what it was made for, or "
            "--out another folder",
            folder.string()));
    }
  }

  /// What this study will not tell of. Where none of its scenes can run it tells of nothing, and all stays.
  void remove_other_runs() {
    std::vector<std::filesystem::path> read_files{order_.reference};
    std::map<std::filesystem::path, std::size_t> numbers;
    bool any_runs = false;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      for (int time = 0; time < order_.times; ++time) numbers[folder_name(i, time)] = i;
      try {
        const HeldScene held = read(overrides_of(i));
        for (std::filesystem::path& file : held.scene.files_read()) read_files.push_back(std::move(file));
        if (!any_runs) {
          const Simulation tried(held.scene, {});
          any_runs = true;
        }
      } catch (const SceneError&) {  // a refused run, which is told of when it is its turn
      } catch (const InputError&) {
      }
    }
    if (!any_runs) return;
    const auto stays = [&](const std::filesystem::path& folder) {
      const auto number = numbers.find(folder.filename());
      const std::optional<Json> record = run_record_in(folder);
      return number != numbers.end() && record &&
             !of_another_study(*record, overrides_of(number->second), order_.scene_hash, order_.simd);
    };
    remove_study(order_.folder, stays, read_files);
  }

  bool interrupted() const { return order_.interrupted != nullptr && *order_.interrupted; }

  void make_one(std::size_t i, std::size_t all) {
    if (interrupted()) return;
    const std::size_t number = i % runs_.size();
    take(number, run_of(number, static_cast<int>(i / runs_.size())));
    const std::lock_guard lock(mutex_);
    if (order_.progress) order_.progress(++done_, all);
  }

  /// What times of a run differ in is their cost.
  void take(std::size_t number, StudyRun run) {
    const std::lock_guard lock(mutex_);
    std::vector<double> cpu = runs_[number].cpu_of_each;
    cpu.insert(cpu.end(), run.cpu_of_each.begin(), run.cpu_of_each.end());
    if (!runs_[number].done) runs_[number] = std::move(run);
    runs_[number].cpu_of_each = std::move(cpu);
  }

  StudyRun run_of(std::size_t i, int time) {
    RunOrder run;
    run.folder = order_.folder / folder_name(i, time);
    run.overrides = overrides_of(i);
    run.scene_hash = order_.scene_hash;
    run.clock = CpuClock::thread;
    run.interrupted = order_.interrupted;
    try {
      const HeldScene held = read(run.overrides);
      refuse_changed_files(held.scene.files);
      const std::vector<StudyLibrary> libraries = libraries_of(held.scene);
      const auto made = [&] {
        return run_in(run.folder, run.overrides, run.scene_hash, held.scene.simd, libraries);
      };
      if (StudyRun before = made(); before.done) return before;
      std::optional<Simulation> simulation;
      try {
        simulation.emplace(held.scene, run.settings);
      } catch (const InputError& error) {
        return refused(run.folder, error.what());
      }
      std::vector<std::filesystem::path> read_files = held.scene.files_read();
      read_files.push_back(order_.reference);
      prepare_output_folder(run.folder, true, read_files);
      record_run(*simulation, run);
      refuse_changed_files(files_now(held.scene.files));
      return made();
    } catch (const SceneError& error) {
      return refused(run.folder, error.mistakes.empty() ? error.what() : error.mistakes[0].text());
    }
  }

  static StudyRun refused(const std::filesystem::path& folder, const std::string& why) {
    StudyRun run;
    run.folder = folder;
    run.end = "refused";
    run.trouble = why;
    run.done = true;
    return run;
  }

  /// Runs whose tables or meshes are not the same ones cannot be compared.
  void refuse_changed_files(const std::map<std::string, std::string>& files) {
    const std::lock_guard lock(mutex_);
    for (const auto& [file, hash] : files) {
      if (const auto [at, is_new] = files_.emplace(file, hash); !is_new && at->second != hash)
        throw InputError(fmt::format(
            "'{}' changed while the study ran, which would compare runs of different scenes: start it again",
            file));
    }
  }

  HeldScene read(const std::vector<Override>& overrides) {
    const std::lock_guard lock(mutex_);
    return order_.read(overrides);
  }

  const StudyOrder& order_;
  std::vector<StudyRun> runs_;
  std::map<std::string, std::string> files_;  ///< that scenes name, and their hashes when first read
  std::size_t done_ = 0;
  std::mutex mutex_;
};

}  // namespace

std::vector<StudyRun> make_runs(const StudyOrder& order) {
  return Runs(order).make();
}

bool finished(const StudyRun& run) {
  return run.end == "finished";
}

std::vector<std::size_t> by_cost(const std::vector<StudyRun>& runs) {
  std::vector<std::size_t> order(runs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t p, std::size_t q) { return runs[p].cpu < runs[q].cpu; });
  return order;
}

}  // namespace talus
