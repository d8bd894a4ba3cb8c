#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace talus {

/// What a call of the talus program gave.
struct Call {
  int code = 0;  ///< exit code; 128 + signal if it was killed
  std::string out, err;
};

/// Runs talus with these words in `folder`, stdout and stderr to files.
Call call_talus(const std::filesystem::path& folder, const std::vector<std::string>& words);

/// The same, sending it `signal` once `file` has come to exist.
Call call_and_signal(const std::filesystem::path& folder, const std::vector<std::string>& words, int signal,
                     const std::filesystem::path& file);

/// A block that falls on a fixed slab, small and quick, as JSON text.
std::string small_scene();

/// A file of JSON.
nlohmann::json json_of(const std::filesystem::path& file);

}  // namespace talus
