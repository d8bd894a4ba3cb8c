#pragma once

#include "plugin/simd_level.hpp"
#include "scene/read.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// All that a run needs to go on as if it had never been broken off: what it was started with, and its state.
struct Checkpoint {
  std::string reason;  ///< why it was written, in words

  std::filesystem::path scene_file;  ///< absolute; files that the scene names are sought from there
  std::string scene_text;
  std::string scene_hash;                    ///< XXH3-128 of the file, whose comments may be no UTF-8
  std::map<std::string, std::string> files;  ///< Scene::files
  std::vector<Override> overrides;
  bool allow_plugins = false;
  std::vector<std::filesystem::path> plugin_folders;  ///< absolute
  struct UsedLibrary {
    std::string file, hash;  ///< name without the folder; XXH3-128
  };
  std::vector<UsedLibrary> libraries;
  SimdLevel simd = SimdLevel::scalar;
  bool neighbour_skin = true;
  int threads = 1;
  std::string model_hash;  ///< Simulation::model_hash()

  double time = 0;  ///< s
  bool settling = false;
  std::uint64_t steps = 0;        ///< without those of a settle stage
  std::vector<double> continued;  ///< s, where the run was broken off before

  std::string state;  ///< bytes of an Archive
};

/// What this program calls itself in a checkpoint: the layout of a state is that of the program.
std::string checkpoint_writer();

/// Writes a checkpoint over an older one: a new file, flushed to the disk, that then takes its name. Throws
/// std::system_error.
void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);

/// Throws InputError, which says what is wrong with the file, or std::system_error.
Checkpoint read_checkpoint(const std::filesystem::path& file);
/// The same from its bytes; `name` stands for the file in messages.
Checkpoint read_checkpoint_text(std::string_view text, const std::string& name);

inline constexpr const char* checkpoint_name = "checkpoint.talus";

}  // namespace talus
