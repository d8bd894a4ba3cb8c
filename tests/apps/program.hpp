#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace talus {

/// What a call of a program gave.
struct Call {
  int code = 0;  ///< exit code; 128 + signal if it was killed
  std::string out, err;
};

/// Runs a program with these words in `folder`, stdout and stderr to files.
Call call_program(const std::filesystem::path& program, const std::filesystem::path& folder,
                  const std::vector<std::string>& words);

/// Runs talus with these words in `folder`, stdout and stderr to files.
Call call_talus(const std::filesystem::path& folder, const std::vector<std::string>& words);

/// The same, sending it `signal` once `file` has come to exist.
Call call_and_signal(const std::filesystem::path& folder, const std::vector<std::string>& words, int signal,
                     const std::filesystem::path& file);

/// The same, sending it `signal` after some time.
Call call_and_signal_after(const std::filesystem::path& folder, const std::vector<std::string>& words,
                           int signal, double seconds);

/// A block that falls on a fixed slab, small and quick, as JSON text.
std::string small_scene();

/// A file of JSON.
nlohmann::json json_of(const std::filesystem::path& file);

}  // namespace talus
