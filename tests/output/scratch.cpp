#include "scratch.hpp"

#include <stdlib.h>

#include <fstream>
#include <stdexcept>

namespace talus {

Scratch::Scratch() {
  std::string name = (std::filesystem::temp_directory_path() / "talus-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  folder_ = name;
}

Scratch::~Scratch() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::filesystem::path Scratch::write(const std::string& name, const std::string& contents) const {
  std::ofstream(folder_ / name) << contents;
  return folder_ / name;
}

}  // namespace talus
