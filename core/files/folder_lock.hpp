#pragma once

#include <filesystem>
#include <utility>

namespace talus {

/// A folder that one program at a time writes into. The system lets go of it with the program, however that
/// ends, and nothing is left behind. Throws InputError while another has it; where a file system knows no
/// locks there is none.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept : handle_(std::exchange(other.handle_, -1)) {}
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Throws InputError while another program writes into a folder, and leaves that as it is; does nothing
  /// where there is none.
  static void refuse_busy(const std::filesystem::path& folder);

 private:
  int handle_;
};

}  // namespace talus
