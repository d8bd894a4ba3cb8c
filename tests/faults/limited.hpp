#pragma once

#include "apps/program.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace talus {

/// What a shell lets a program have; 0 is no limit.
struct Limits {
  int file_kilobytes = 0;  ///< of one file, in steps of 512 bytes or more
  int memory_megabytes = 0;
  int seconds = 0;  ///< of the processor
};

/// Runs talus with these words in `folder`, within limits.
Call call_within(const Limits& limits, const std::filesystem::path& folder,
                 const std::vector<std::string>& words);

/// The same with stdout into a file, such as /dev/full.
Call call_into(const std::string& file, const std::filesystem::path& folder,
               const std::vector<std::string>& words);

}  // namespace talus
