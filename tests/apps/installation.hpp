#pragma once

#include "apps/program.hpp"
#include "output/scratch.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace talus {

/// talus installed to a prefix of its own, as a stranger has it, removed afterwards.
class Installation {
 public:
  Installation();

  std::filesystem::path prefix() const { return scratch_ / "prefix"; }
  /// A folder to work in, apart from the prefix.
  std::filesystem::path work() const { return scratch_ / "work"; }
  /// Calls the installed program in work().
  Call talus(const std::vector<std::string>& words) const;
  /// Runs a line of shell in work() with the installed program on the path.
  Call shell(const std::string& line) const;

 private:
  Scratch scratch_;
};

/// Whether a compiler is there to be called; a test that needs it and does not find it says so and ends.
bool has_compiler(const std::string& name);

/// Builds a source of one file as a plugin without CMake's help, as `compiler` with `flags` does it.
void build_plugin(const std::string& compiler, const std::string& flags, const std::filesystem::path& kit,
                  const std::filesystem::path& source, const std::filesystem::path& library);

}  // namespace talus
