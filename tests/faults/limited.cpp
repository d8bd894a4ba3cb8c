#include "limited.hpp"

#include <fmt/format.h>

namespace talus {

namespace {

std::string quoted(const std::vector<std::string>& words) {
  std::string all = fmt::format("'{}'", TALUS_PROGRAM);
  for (const std::string& word : words) all += fmt::format(" '{}'", word);
  return all;
}

Call shell(const std::filesystem::path& folder, const std::string& command) {
  return call_program("/bin/sh", folder, {"-c", command});
}

}  // namespace

Call call_within(const Limits& limits, const std::filesystem::path& folder,
                 const std::vector<std::string>& words) {
  std::string command;
  // sh counts blocks of 512 bytes.
  if (limits.file_kilobytes > 0) command += fmt::format("ulimit -f {}; ", 2 * limits.file_kilobytes);
#ifdef TALUS_SANITIZED  // AddressSanitizer reserves terabytes and takes some eight times as long
  const int seconds = 8 * limits.seconds;
#else
  const int seconds = limits.seconds;
  if (limits.memory_megabytes > 0) command += fmt::format("ulimit -v {}; ", 1024 * limits.memory_megabytes);
#endif
  if (seconds > 0) command += fmt::format("ulimit -t {}; ", seconds);
  return shell(folder, command + "exec " + quoted(words));
}

Call call_into(const std::string& file, const std::filesystem::path& folder,
               const std::vector<std::string>& words) {
  // The shell's own redirection comes after that of call_program.
  return shell(folder, fmt::format("exec {} > {}", quoted(words), file));
}

}  // namespace talus
