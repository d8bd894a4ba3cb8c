#include "files/whole_file.hpp"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
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

/// Whether it succeeded; if not, errno says why.
bool flushed(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool success = ::fsync(descriptor) == 0;
  const int reason = errno;
  ::close(descriptor);
  errno = reason;
  return success;
}

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : ".";
}

/// Whether a name stands for what some process holds open, as /proc/self/fd/1 does, which /dev/stdout leads
/// to. What the kernel shows as such a link is no name to follow: of a pipe it is none, and a file that takes
/// the place of the one that is named is not what is open.
bool is_held_open(const std::filesystem::path& file) {
  std::error_code unknown;
  const std::string folder = std::filesystem::canonical(folder_of(file), unknown).string();
  return folder.starts_with("/proc/") && folder.ends_with("/fd") && std::filesystem::is_symlink(file);
}

/// A link keeps pointing where it does: what it names is written.
std::filesystem::path followed(std::filesystem::path file) {
  constexpr int most_links = 40;  // as the kernel has it
  for (int link = 0; link < most_links && std::filesystem::is_symlink(file) && !is_held_open(file); ++link)
    file = file.parent_path() / std::filesystem::read_symlink(file);
  return file;
}

/// A new file beside one, which nobody else has or leads elsewhere: FILE.part, or FILE.part2 and so on where
/// that is there.
std::filesystem::path new_beside(const std::filesystem::path& file) {
  constexpr int most_tried = 100;
  for (int number = 1; number <= most_tried; ++number) {
    std::filesystem::path temporary = file;
    temporary += number == 1 ? ".part" : fmt::format(".part{}", number);
    const int descriptor =
        ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor < 0 && (errno == EEXIST || errno == ELOOP)) continue;
    if (descriptor < 0) fail("cannot write", file);
    ::close(descriptor);
    return temporary;
  }
  fail("cannot write", file);
}

void write_into(const std::filesystem::path& file, std::string_view contents) {
  errno = 0;
  std::ofstream stream(file, std::ios::binary);
  stream.write(contents.data(), static_cast<std::streamsize>(contents.size()));
  stream.close();
  if (!stream) fail("cannot write", file);
}

/// Of this process the same opening, so that what is appended to stays, and what others write comes behind.
int opened_again(const std::filesystem::path& held_open) {
  const std::string number = held_open.filename();
  int descriptor = -1;
  std::from_chars(number.data(), number.data() + number.size(), descriptor);
  std::error_code unknown;
  return std::filesystem::equivalent(folder_of(held_open), "/proc/self/fd", unknown)
             ? ::fcntl(descriptor, F_DUPFD_CLOEXEC, 0)
             : ::open(held_open.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
}

void write_through(const std::filesystem::path& held_open, std::string_view contents) {
  std::fflush(nullptr);  // what was printed before comes first
  const int descriptor = opened_again(held_open);
  if (descriptor < 0) fail("cannot write", held_open);
  while (!contents.empty()) {
    const ssize_t written = ::write(descriptor, contents.data(), contents.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int reason = errno;
      ::close(descriptor);
      errno = reason;
      fail("cannot write", held_open);
    }
    contents.remove_prefix(static_cast<std::size_t>(written));
  }
  ::close(descriptor);
}

}  // namespace

void write_whole_file(const std::filesystem::path& file, std::string_view contents, Durability durability) {
  const std::filesystem::path place = followed(file);
  if (is_held_open(place)) {
    write_through(place, contents);
    return;
  }
  std::error_code problem;  // what cannot be looked at cannot be written either, and that is told below
  const bool loops = std::filesystem::is_symlink(place);
  if (loops || std::filesystem::is_directory(place, problem)) {
    errno = loops ? ELOOP : EISDIR;
    fail("cannot write", place);
  }
  // A pipe or a device has no place that another file could take.
  if (std::filesystem::exists(place, problem) && !std::filesystem::is_regular_file(place, problem)) {
    write_into(place, contents);
    return;
  }
  const std::filesystem::path temporary = new_beside(place);
  errno = 0;
  std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
  stream.write(contents.data(), static_cast<std::streamsize>(contents.size()));
  stream.close();
  if (!stream) fail_without(temporary, place);
  // What may be done with it is as with the one whose place it takes.
  if (struct stat former{}; ::stat(place.c_str(), &former) == 0)
    ::chmod(temporary.c_str(), former.st_mode & 0777);
  if (durability == Durability::on_disk && !flushed(temporary)) fail_without(temporary, place);
  std::filesystem::rename(temporary, place, problem);
  if (problem) {
    errno = problem.value();
    fail_without(temporary, place);
  }
  if (durability == Durability::on_disk) flush_to_disk(folder_of(place));
}

std::vector<std::filesystem::path> temporaries_of(const std::filesystem::path& file) {
  const std::string beginning = file.filename().string() + ".part";
  std::vector<std::filesystem::path> found;
  std::error_code none;  // a folder that is not there holds none
  for (const std::filesystem::directory_entry& entry :
       std::filesystem::directory_iterator(folder_of(file), none)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(beginning) &&
        name.find_first_not_of("0123456789", beginning.size()) == std::string::npos)
      found.push_back(file.parent_path() / name);
  }
  std::sort(found.begin(), found.end());
  return found;
}

void flush_to_disk(const std::filesystem::path& path) {
  errno = 0;
  if (!flushed(path)) fail("cannot write", path);
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
