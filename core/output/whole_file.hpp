#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace talus {

/// Writes a file that is whole at any moment: into a temporary beside it, which then takes its name. Throws
/// std::system_error that names the file.
void write_whole_file(const std::filesystem::path& file, std::string_view contents);

/// All bytes of a file. Throws std::system_error that names the file.
std::string read_whole_file(const std::filesystem::path& file);

}  // namespace talus
