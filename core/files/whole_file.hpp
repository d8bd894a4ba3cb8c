#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// Where the contents of a file are when writing returns: a file on the disk outlives a failure of the power.
enum class Durability { with_the_system, on_disk };

/// Writes a file that is whole at any moment: into a temporary beside it, which then takes its name. Links
/// are followed; pipes, devices and what a process holds open (/dev/stdout, /dev/fd/3) are written into, the
/// last from where they stand. Throws std::system_error that names the file.
void write_whole_file(const std::filesystem::path& file, std::string_view contents,
                      Durability durability = Durability::with_the_system);

/// Temporaries beside a file that writers which were killed left there, by name.
std::vector<std::filesystem::path> temporaries_of(const std::filesystem::path& file);

/// Sees to it that what was written to a file, or for the names in it to a folder, outlives a failure of the
/// power. Throws std::system_error that names it.
void flush_to_disk(const std::filesystem::path& path);

/// All bytes of a file. Throws std::system_error that names the file.
std::string read_whole_file(const std::filesystem::path& file);

}  // namespace talus
