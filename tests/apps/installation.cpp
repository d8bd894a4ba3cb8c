#include "installation.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <stdexcept>

namespace talus {

Installation::Installation() {
  std::filesystem::create_directories(work());
  const Call call =
      call_program(TALUS_CMAKE, work(), {"--install", TALUS_BUILD, "--prefix", prefix().string()});
  if (call.code != 0) throw std::runtime_error("talus could not be installed: " + call.err);
}

Call Installation::talus(const std::vector<std::string>& words) const {
  return call_program(prefix() / "bin" / "talus", work(), words);
}

Call Installation::shell(const std::string& line) const {
  return call_program("/bin/sh", work(),
                      {"-c", fmt::format("PATH='{}/bin':$PATH; {}", prefix().string(), line)});
}

bool has_compiler(const std::string& name) {
  return std::system((name + " --version > /dev/null 2>&1").c_str()) == 0;
}

void build_plugin(const std::string& compiler, const std::string& flags, const std::filesystem::path& kit,
                  const std::filesystem::path& source, const std::filesystem::path& library) {
  std::filesystem::create_directories(library.parent_path());
  const std::string line =
      fmt::format("{} -std=c++20 -shared -fPIC -fvisibility=hidden -ffp-contract=off {} -I'{}' '{}' -o '{}'",
                  compiler, flags, kit.string(), source.string(), library.string());
  if (std::system(line.c_str()) != 0) throw std::runtime_error("this does not build: " + line);
}

}  // namespace talus
