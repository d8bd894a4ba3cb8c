#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace talus {

/// XXH3 128 bit of some bytes as 32 hexadecimal digits, as `xxh128sum` prints it.
std::string hash_of_bytes(std::string_view bytes);

std::string hash_of_file(const std::filesystem::path& file);

/// The same of bytes that come one after the other.
class RunningHash {
 public:
  RunningHash();
  ~RunningHash();
  RunningHash(const RunningHash&) = delete;
  RunningHash& operator=(const RunningHash&) = delete;

  void add(std::string_view bytes);
  std::string text() const;  ///< of all that was added

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace talus
