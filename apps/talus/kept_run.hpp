#pragma once

#include "checkpoint/checkpoint.hpp"
#include "log.hpp"
#include "plugin/registry.hpp"
#include "simulation/simulation.hpp"

#include <filesystem>
#include <vector>

namespace talus {

/// The checkpoint that is meant by a file or by the folder of a run.
std::filesystem::path checkpoint_file(const std::filesystem::path& given);

/// The same. Throws InputError where the run is at its end and none was kept.
std::filesystem::path checkpoint_to_go_on_from(const std::filesystem::path& given);

/// The simulation of a checkpoint as it was started, and what it points into. Throws InputError where it
/// would not be the same: another instruction set, library or file that the scene names.
/// `allow_plugins`: libraries that the scene names by path, or of folders that the run was started with, run
/// with the rights of who goes on; LibrariesNotAllowed without.
struct KeptRun {
  KeptRun(const Checkpoint& checkpoint, const RunSettings& settings,
          const std::vector<std::filesystem::path>& more_plugin_folders, bool allow_plugins,
          const Log& log = {});

  Registry registry;
  Simulation simulation;
};

}  // namespace talus
