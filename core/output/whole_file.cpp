#include "output/whole_file.hpp"

#include <fmt/format.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <system_error>
#include <vector>

namespace talus {

namespace {

[[noreturn]] void fail(const char* what, const std::filesystem::path& file) {
  const int reason = errno != 0 ? errno : EIO;
  throw std::system_error(reason, std::generic_category(), fmt::format("{} '{}'", what, file.string()));
}

/// A file that could not be written leaves nothing: least of all where the disk is full.
[[noreturn]] void fail_without(const std::filesystem::path& temporary, const std::filesystem::path& file) {
  const int reason = errno;
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  errno = reason;
  fail("cannot write", file);
}

/// Of a file or, for the names in it, a folder.
void flush_to_disk(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail("cannot open", path);
  const bool flushed = ::fsync(descriptor) == 0;
  ::close(descriptor);
  if (!flushed) fail("cannot write", path);
}

}  // namespace

void write_whole_file(const std::filesystem::path& file, std::string_view contents, Durability durability) {
  std::filesystem::path temporary = file;
  temporary += ".part";
  errno = 0;
  std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
  stream.write(contents.data(), static_cast<std::streamsize>(contents.size()));
  stream.close();
  if (!stream) fail_without(temporary, file);
  if (durability == Durability::on_disk) flush_to_disk(temporary);
  std::error_code problem;
  std::filesystem::rename(temporary, file, problem);
  if (problem) throw std::system_error(problem, fmt::format("cannot write '{}'", file.string()));
  if (durability == Durability::on_disk) flush_to_disk(file.has_parent_path() ? file.parent_path() : ".");
}

std::string read_whole_file(const std::filesystem::path& file) {
  errno = 0;
  if (std::filesystem::is_directory(file)) {
    errno = EISDIR;
    fail("cannot read", file);
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail("cannot read", file);
  // A file has an end, /dev/zero has none.
  const bool ends = std::filesystem::is_regular_file(file);
  constexpr std::size_t most_of_others = 100'000'000;
  std::string contents;
  std::vector<char> part(std::size_t{1} << 16);
  do {
    stream.read(part.data(), static_cast<std::streamsize>(part.size()));
    contents.append(part.data(), static_cast<std::size_t>(stream.gcount()));
    if (!ends && contents.size() > most_of_others) {
      errno = EFBIG;
      fail("cannot read", file);
    }
  } while (stream);
  if (stream.bad()) fail("cannot read", file);
  return contents;
}

}  // namespace talus
