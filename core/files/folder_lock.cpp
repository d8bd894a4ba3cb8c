#include "files/folder_lock.hpp"

#include "files/input_error.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <fmt/format.h>

#include <cerrno>

namespace talus {

namespace {

/// `kind`: that of flock(). A negative number where the folder cannot be opened.
int open_locked(const std::filesystem::path& folder, int kind) {
  const int handle = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (handle < 0 || flock(handle, kind | LOCK_NB) == 0 || errno != EWOULDBLOCK) return handle;
  close(handle);
  throw InputError(
      fmt::format("'{}' is being written by another talus: wait for it, or give --out another "
                  "folder",
                  folder.string()));
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder) : handle_(open_locked(folder, LOCK_EX)) {}

void FolderLock::refuse_busy(const std::filesystem::path& folder) {
  // Shared, so that those who ask at the same time are not in each other's way.
  const int handle = open_locked(folder, LOCK_SH);
  if (handle >= 0) close(handle);
}

FolderLock::~FolderLock() {
  if (handle_ >= 0) close(handle_);
}

}  // namespace talus
