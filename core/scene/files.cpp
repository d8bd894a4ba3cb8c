#include "scene/files.hpp"

#include "files/hash.hpp"

#include <system_error>

namespace talus {

namespace fs = std::filesystem;

NamedFile named_file(const fs::path& folder, const std::string& written) {
  NamedFile named{folder / written, {}, {}};
  if (!is_file(named.file)) {
    // Paths and names of columns may hold colons: the longest path that is there, or all before the last.
    std::size_t colon = written.rfind(':');
    for (std::size_t at = colon; at != std::string::npos && at > 0; at = written.rfind(':', at - 1)) {
      if (!is_file(folder / written.substr(0, at))) continue;
      colon = at;
      break;
    }
    if (colon != std::string::npos) {
      named.file = folder / written.substr(0, colon);
      named.part = written.substr(colon + 1);
    }
  }
  named.resolved = fs::absolute(named.file).lexically_normal().string();
  if (!named.part.empty()) named.resolved += ':' + named.part;
  return named;
}

bool is_file(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored);
}

void note_file(std::map<std::string, std::string>& files, const fs::path& file) {
  files[fs::absolute(file).lexically_normal().string()] = hash_of_file(file);
}

}  // namespace talus
