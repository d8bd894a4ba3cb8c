#include "output/whole_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

namespace talus {

namespace {

[[noreturn]] void fail(const char* what, const std::filesystem::path& file) {
  const int reason = errno != 0 ? errno : EIO;
  throw std::system_error(reason, std::generic_category(), fmt::format("{} '{}'", what, file.string()));
}

}  // namespace

void write_whole_file(const std::filesystem::path& file, std::string_view contents) {
  std::filesystem::path temporary = file;
  temporary += ".part";
  errno = 0;
  std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
  stream.write(contents.data(), static_cast<std::streamsize>(contents.size()));
  stream.close();
  if (!stream) fail("cannot write", temporary);
  std::error_code problem;
  std::filesystem::rename(temporary, file, problem);
  if (problem) throw std::system_error(problem, fmt::format("cannot write '{}'", file.string()));
}

std::string read_whole_file(const std::filesystem::path& file) {
  errno = 0;
  if (std::filesystem::is_directory(file)) {
    errno = EISDIR;
    fail("cannot read", file);
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail("cannot read", file);
  std::string contents{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (stream.bad()) fail("cannot read", file);
  return contents;
}

}  // namespace talus
