#include "files/whole_file.hpp"
#include "targets.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>

using namespace talus;

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> files_of(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

TEST_CASE("What fuzzing found once, and its seeds, are read or refused in words", "[fuzz]") {
  for (const fuzz::Target& target : fuzz::targets) {
    const std::vector<fs::path> files = files_of(fs::path(TALUS_FUZZ_CORPUS) / target.name);
    CHECK_FALSE(files.empty());
    for (const fs::path& file : files) {
      CAPTURE(file);
      CHECK_NOTHROW(target.run(read_whole_file(file)));
    }
  }
}

TEST_CASE("Cut off or changed anywhere, seeds are read or refused in words", "[fuzz]") {
  for (const fuzz::Target& target : fuzz::targets) {
    for (const fs::path& file : files_of(fs::path(TALUS_FUZZ_CORPUS) / target.name)) {
      const std::string whole = read_whole_file(file);
      const std::size_t step = std::max<std::size_t>(1, whole.size() / 40);
      for (std::size_t at = 0; at < whole.size(); at += step) {
        CAPTURE(file, at);
        CHECK_NOTHROW(target.run(std::string_view(whole).substr(0, at)));
        std::string changed = whole;
        changed[at] = static_cast<char>(changed[at] ^ 1 << at % 8);
        CHECK_NOTHROW(target.run(changed));
      }
    }
  }
}
