#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace talus {

/// XXH3 128 bit of some bytes as 32 hexadecimal digits, as `xxh128sum` prints it.
std::string hash_of_bytes(std::string_view bytes);

std::string hash_of_file(const std::filesystem::path& file);

}  // namespace talus
