#include "scene/files.hpp"

#include "files/hash.hpp"

#include <system_error>

namespace talus {

namespace fs = std::filesystem;

NamedFile named_file(const fs::path& folder, const std::string& written) {
  NamedFile named{folder / written, {}, {}};
  const std::size_t colon = written.rfind(':');
  if (colon != std::string::npos && !is_file(named.file)) {
    named.file = folder / written.substr(0, colon);
    named.part = written.substr(colon + 1);
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
