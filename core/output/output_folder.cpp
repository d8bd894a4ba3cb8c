#include "output/output_folder.hpp"

#include "checkpoint/checkpoint.hpp"
#include "files/folder_lock.hpp"
#include "files/input_error.hpp"
#include "files/whole_file.hpp"
#include "output/records.hpp"
#include "scene/quantity.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace talus {

namespace {

namespace fs = std::filesystem;

/// By the name that a run gives it, with six digits and more: others may lie beside, and are not ours.
bool is_frame(const fs::path& file) {
  const std::string name = file.filename().string();
  const std::size_t digits = name.find('_') + 1, end = name.find_first_not_of("0123456789", digits);
  return (name.starts_with("frame_") || name.starts_with("contacts_")) && end != std::string::npos &&
         end - digits >= 6 && (name.substr(end) == ".vtu" || name.substr(end).starts_with(".vtu.part"));
}

constexpr const char* files_of_run[] = {
    "history.csv",           "resolved.json", "run.json",      "frames.pvd",  "energy.csv",  "safety.csv",
    "safety.json",           "safety.svg",    "mechanism.svg", "report.html", "compare.csv", "compare.json",
    "compare_reference.csv", checkpoint_name};
constexpr const char* files_of_study[] = {"study.csv", "study.json", "study.svg", "study.html"};

std::vector<fs::path> present(const fs::path& folder, std::span<const char* const> names) {
  std::vector<fs::path> found;
  for (const char* name : names) {
    if (fs::exists(folder / name)) found.push_back(folder / name);
    for (fs::path& temporary : temporaries_of(folder / name)) found.push_back(std::move(temporary));
  }
  return found;
}

/// What `talus view` drew of the results of a folder, by the names that it gives.
std::vector<fs::path> figures_in(const fs::path& folder) {
  if (!fs::exists(folder / "run.json") && !fs::exists(folder / "compare.json")) return {};
  std::vector<std::string> names{"contact_forces.svg"};
  for (const Quantity& quantity : quantities()) names.push_back(fmt::format("{}.svg", quantity.name));
  std::vector<std::string> runs{""};
  if (const auto comparison = comparison_record_in(folder)) {
    for (const auto& run : comparison->at("runs"))
      runs.push_back(fmt::format("_{}", fs::path(run.at("folder").get<std::string>()).filename().string()));
  }
  for (const char* kind : {"energy", "first_state", "last_state"}) {
    for (const std::string& run : runs) names.push_back(fmt::format("{}{}.svg", kind, run));
  }
  std::vector<const char*> each;
  for (const std::string& name : names) each.push_back(name.c_str());
  return present(folder / "figures", each);
}

std::vector<fs::path> results_in(const fs::path& folder) {
  std::vector<fs::path> found = present(folder, files_of_run);
  for (fs::path& figure : figures_in(folder)) found.push_back(std::move(figure));
  if (fs::is_directory(folder / "frames")) {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / "frames")) {
      if (is_frame(entry.path())) found.push_back(entry.path());
    }
  }
  return found;
}

/// As a study names the folders of its runs: run_0001, and run_0001_2 for the second time.
bool is_name_of_run(const std::string& name) {
  constexpr std::string_view digits = "0123456789", digits_and_line = "0123456789_";
  return name.size() >= 8 && name.starts_with("run_") && name.find_first_not_of(digits, 4) >= 8 &&
         name.find_first_not_of(digits_and_line, 4) == std::string::npos;
}

std::vector<fs::path> runs_of_study(const fs::path& folder) {
  std::vector<fs::path> runs;
  if (!fs::is_directory(folder)) return runs;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (is_name_of_run(entry.path().filename().string()) && entry.is_directory() &&
        !results_in(entry.path()).empty())
      runs.push_back(entry.path());
  }
  std::sort(runs.begin(), runs.end());
  return runs;
}

/// What is no folder, and one that nobody may write into: it, or the nearest that it would lie in.
void refuse_unfit(const fs::path& folder) {
  if (fs::exists(fs::symlink_status(folder)) && !fs::is_directory(folder))
    throw InputError(fmt::format("'{}' is in the way: it is a file, not a folder", folder.string()));
  fs::path there = fs::absolute(folder);
  while (!fs::exists(there) && there.has_relative_path()) there = there.parent_path();
  if (access(there.c_str(), W_OK | X_OK) != 0)
    throw std::system_error(errno, std::generic_category(),
                            fmt::format("cannot write into '{}'", folder.string()));
}

/// The one of the files that were `read` that a result is, or null: results of before are what they are by
/// name, and one may be the scene itself.
const fs::path* read_as(const fs::path& result, const std::vector<fs::path>& read) {
  for (const fs::path& file : read) {
    std::error_code unknown;
    if (fs::equivalent(file, result, unknown)) return &file;
  }
  return nullptr;
}

void refuse_to_remove(const fs::path& result, const std::vector<fs::path>& read) {
  const fs::path* const file = read_as(result, read);
  if (file == nullptr) return;
  throw InputError(fmt::format(
      "'{}' is read to make the results that would replace it: give --out another folder", file->string()));
}

/// A study cannot go on in a folder that has other results beside its runs.
void refuse_study(const fs::path& folder) {
  std::vector<fs::path> of_study = present(folder, files_of_study);
  for (fs::path& run : runs_of_study(folder)) of_study.push_back(std::move(run));
  if (of_study.empty()) return;
  throw InputError(fmt::format(
      "'{}' holds a study ('{}'), which could not go on beside other results: give --out another folder, or "
      "--overwrite to replace its tables",
      folder.string(), of_study[0].filename().string()));
}

/// Of a link only what it leads to is meant.
void remove_if_empty(const fs::path& folder) {
  std::error_code kept;
  if (!fs::is_symlink(folder, kept) && fs::is_directory(folder, kept) && fs::is_empty(folder, kept))
    fs::remove(folder, kept);
}

void remove_files_of_run(const fs::path& run) {
  const FolderLock mine(run);
  for (const fs::path& file : results_in(run)) fs::remove(file);
  for (const char* within : {"frames", "figures"}) remove_if_empty(run / within);
  remove_if_empty(run);
}

}  // namespace

std::vector<fs::path> refuse_output_folder(const fs::path& folder, bool overwrite,
                                           const std::vector<fs::path>& read) {
  refuse_unfit(folder);
  FolderLock::refuse_busy(folder);
  std::vector<fs::path> results = results_in(folder);
  if (!results.empty() && !overwrite) {
    throw InputError(fmt::format(
        "'{}' holds results already ('{}'): give --overwrite to replace them or --out for another "
        "folder",
        folder.string(), results[0].filename().string()));
  }
  if (!overwrite) refuse_study(folder);
  for (fs::path& file : present(folder, files_of_study)) results.push_back(std::move(file));
  for (const fs::path& file : results) refuse_to_remove(file, read);
  return results;
}

void prepare_output_folder(const fs::path& folder, bool overwrite, const std::vector<fs::path>& read) {
  const std::vector<fs::path> results = refuse_output_folder(folder, overwrite, read);
  fs::create_directories(folder);
  const FolderLock mine(folder);
  for (const fs::path& file : results) fs::remove(file);
  remove_if_empty(folder / "figures");
}

void prepare_folder_of_runs(const fs::path& folder, const std::vector<fs::path>& read) {
  refuse_unfit(folder);
  if (const std::vector<fs::path> results = results_in(folder); !results.empty()) {
    throw InputError(fmt::format(
        "'{}' holds results of {} ('{}'): give --out another folder", folder.string(),
        comparison_record_in(folder) ? "a comparison" : "a single run", results[0].filename().string()));
  }
  for (const char* name : files_of_study) refuse_to_remove(folder / name, read);
  fs::create_directories(folder);
}

void remove_study(const fs::path& folder, const std::function<bool(const fs::path&)>& stays,
                  const std::vector<fs::path>& read) {
  std::vector<fs::path> files = present(folder, files_of_study), runs = runs_of_study(folder);
  std::erase_if(runs, stays);
  for (const fs::path& run : runs) {
    for (fs::path& file : results_in(run)) files.push_back(std::move(file));
  }
  for (const fs::path& file : files) refuse_to_remove(file, read);
  for (const fs::path& run : runs) {
    FolderLock::refuse_busy(run);
    refuse_unfit(run);
  }
  for (const fs::path& table : present(folder, files_of_study)) fs::remove(table);
  for (const fs::path& run : runs) remove_files_of_run(run);
}

void remove_run(const fs::path& folder, const std::vector<fs::path>& read) {
  if (fs::is_symlink(folder) || !fs::is_directory(folder)) return;
  for (const fs::path& file : results_in(folder)) {
    if (read_as(file, read) != nullptr) return;
  }
  remove_files_of_run(folder);
}

void refuse_among_runs_at_work(const fs::path& folder) {
  const fs::path whole = fs::weakly_canonical(fs::absolute(folder));
  for (fs::path around = whole.parent_path(); around.has_relative_path(); around = around.parent_path()) {
    if (fs::exists(around / "compare.json") || fs::exists(around / "run_0001"))
      FolderLock::refuse_busy(around);
  }
}

bool holds_finished_run(const fs::path& folder) {
  const auto record = run_record_in(folder);
  return record && record->at("end") == "finished";
}

}  // namespace talus
