#include "kept_run.hpp"

#include "scene_options.hpp"

#include "files/input_error.hpp"
#include "files/whole_file.hpp"
#include "output/output_folder.hpp"
#include "output/records.hpp"
#include "output/run_record.hpp"
#include "scene/files.hpp"
#include "text/shell_word.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace talus {
namespace {

/// Folders of libraries that the run was started with. A checkpoint may come from anybody.
void refuse_unasked_folders(const Checkpoint& checkpoint,
                            const std::vector<std::filesystem::path>& searched) {
  std::string folders, options;
  for (const std::filesystem::path& folder : checkpoint.plugin_folders) {
    const auto same = [&](const std::filesystem::path& other) {
      std::error_code none;
      return std::filesystem::equivalent(folder, other, none);
    };
    if (!std::filesystem::is_directory(folder) || std::any_of(searched.begin(), searched.end(), same))
      continue;
    folders += (folders.empty() ? "" : " and ") + folder.string();
    options += " --plugin-path " + shell_word(folder.string());
  }
  if (folders.empty()) return;
  throw LibrariesNotAllowed(
      SceneError({{checkpoint.scene_file.string(), 0, 0, "",
                   fmt::format("the run was started with libraries of {}, which run with "
                               "your rights: give --allow-plugins, or{}",
                               folders, options)}}));
}

Registry registry_of(const Checkpoint& checkpoint, std::vector<std::filesystem::path> folders,
                     bool allow_plugins) {
  if (checkpoint.simd > best_simd_level()) {
    throw InputError(
        fmt::format("the run was started with {} instructions, this machine has no more than {}: go on where "
                    "it was started",
                    name_of(checkpoint.simd), name_of(best_simd_level())));
  }
  if (!allow_plugins) refuse_unasked_folders(checkpoint, search_path(folders));
  for (const std::filesystem::path& folder : checkpoint.plugin_folders) {
    if (std::filesystem::is_directory(folder)) folders.push_back(folder);
  }
  Registry registry;
  registry.simd = checkpoint.simd;
  offer_folders(registry, search_path(folders));
  return registry;
}

void check_libraries(const Checkpoint& checkpoint, const Scene& scene) {
  const std::vector<Checkpoint::UsedLibrary> now = hashed_libraries(scene);
  for (const Checkpoint::UsedLibrary& then : checkpoint.libraries) {
    const auto same = [&](const Checkpoint::UsedLibrary& library) { return library.hash == then.hash; };
    if (std::any_of(now.begin(), now.end(), same)) continue;
    throw InputError(
        fmt::format("the library {} that the run was started with is not the one found now (its hash "
                    "was {}): name the folder of the old one with --plugin-path",
                    then.file, then.hash));
  }
}

void check_files(const Checkpoint& checkpoint, const Scene& scene) {
  if (scene.files == checkpoint.files) return;
  std::string changed;
  for (const auto& [file, hash] : checkpoint.files) {
    const auto now = scene.files.find(file);
    if (now == scene.files.end() || now->second != hash)
      changed += fmt::format("{}'{}'", changed.empty() ? "" : ", ", file);
  }
  throw InputError(
      fmt::format("what the scene '{}' reads is no longer what the run was started with: {} changed; restore "
                  "it, or run the scene anew",
                  checkpoint.scene_file.string(), changed));
}

Scene read_again(const Checkpoint& checkpoint, Registry& registry, bool allow_plugins) {
  try {
    return read_scene_text(checkpoint.scene_text, checkpoint.scene_file.string(), registry,
                           {checkpoint.overrides, allow_plugins});
  } catch (const SceneError& problem) {
    if (wants_permission(problem)) throw LibrariesNotAllowed(problem);
    throw;
  }
}

Scene scene_of(const Checkpoint& checkpoint, Registry& registry, bool allow_plugins, const Log& log) {
  Scene scene = read_again(checkpoint, registry, allow_plugins);
  for (const std::string& warning : scene.warnings) log.warning(warning);
  if (is_file(checkpoint.scene_file) && read_whole_file(checkpoint.scene_file) != checkpoint.scene_text)
    log.warning(
        fmt::format("'{}' has changed since the run was started: it goes on with the scene of then; run "
                    "the scene anew for what it says now",
                    checkpoint.scene_file.string()));
  check_libraries(checkpoint, scene);
  check_files(checkpoint, scene);
  return scene;
}

/// Its folder, or that of one of its runs.
bool is_of_comparison(const std::filesystem::path& given) {
  if (!std::filesystem::is_directory(given)) return false;
  if (comparison_record_in(given)) return true;
  const std::filesystem::path folder = std::filesystem::canonical(given);
  const auto comparison = comparison_record_in(folder.parent_path());
  return comparison && std::ranges::any_of(comparison->at("runs"), [&](const auto& run) {
           return std::filesystem::path(run.at("folder").template get<std::string>()).filename() ==
                  folder.filename();
         });
}

}  // namespace

std::filesystem::path checkpoint_file(const std::filesystem::path& given) {
  return std::filesystem::is_directory(given) ? given / checkpoint_name : given;
}

std::filesystem::path checkpoint_to_go_on_from(const std::filesystem::path& given) {
  std::filesystem::path file = checkpoint_file(given);
  if (!std::filesystem::exists(file) && holds_finished_run(given))
    throw InputError(
        fmt::format("the run in '{}' is at its end, so nothing is kept to go on with", given.string()));
  if (!std::filesystem::exists(file) && is_of_comparison(given))
    throw InputError(
        fmt::format("'{}' is of a comparison, which keeps no checkpoint: it begins anew with the words that "
                    "began it",
                    given.string()));
  return file;
}

KeptRun::KeptRun(const Checkpoint& checkpoint, const RunSettings& settings,
                 const std::vector<std::filesystem::path>& more_plugin_folders, bool allow_plugins,
                 const Log& log)
    : registry(registry_of(checkpoint, more_plugin_folders, allow_plugins)),
      simulation(scene_of(checkpoint, registry, allow_plugins, log), settings) {
  if (simulation.model_hash() != checkpoint.model_hash) {
    throw InputError(
        fmt::format("the bodies of '{}' are no longer those of the run: a file that the scene names "
                    "has changed; restore it, or run the scene anew",
                    checkpoint.scene_file.string()));
  }
}

}  // namespace talus
