#include "files/folder_lock.hpp"

#include "files/input_error.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <fmt/format.h>

#include <cerrno>

namespace talus {

FolderLock::FolderLock(const std::filesystem::path& folder)
    : handle_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (handle_ < 0 || flock(handle_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  close(handle_);
  throw InputError(
      fmt::format("'{}' is being written by another talus: wait for it, or give --out another "
                  "folder",
                  folder.string()));
}

FolderLock::~FolderLock() {
  if (handle_ >= 0) close(handle_);
}

}  // namespace talus
