#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace talus {

/// What "file" or "file:part" means that stands in a scene of this folder.
struct NamedFile {
  std::filesystem::path file;
  std::string part;      ///< "" where none is named
  std::string resolved;  ///< the same as an absolute path: the resolved scene may be read from another folder
};

NamedFile named_file(const std::filesystem::path& folder, const std::string& written);

/// Whether it is an ordinary file. A device would not end, a pipe not begin.
bool is_file(const std::filesystem::path& file);

/// Notes a file that was read, by its absolute path, with its XXH3-128.
void note_file(std::map<std::string, std::string>& files, const std::filesystem::path& file);

}  // namespace talus
