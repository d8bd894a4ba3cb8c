#include "verification/bench.hpp"

#include "files/whole_file.hpp"

#include <stdlib.h>

#include <fmt/format.h>

#include <cerrno>
#include <system_error>

namespace talus::verification {

Scene Bench::shipped(const std::string& name, const std::vector<Override>& overrides) const {
  const std::lock_guard lock(reading_);
  return read_scene(scenes_ / (name + ".json"), registry_, {overrides, false});
}

Scene Bench::from_text(const std::string& text, const std::vector<Override>& overrides) const {
  const std::lock_guard lock(reading_);
  return read_scene_text(text, "scene.json", registry_, {overrides, false});
}

std::string polygon_text(const std::vector<Vec2>& corners) {
  std::string text;
  for (const Vec2 corner : corners)
    text += fmt::format("{}[{:.17g}, {:.17g}]", text.empty() ? "[" : ", ", corner.x, corner.y);
  return text + ']';
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "talus-verify-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::system_error(errno, std::generic_category(), name);
  folder_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::string TemporaryFolder::write(const std::string& name, const std::string& contents) const {
  write_whole_file(folder_ / name, contents);
  return (folder_ / name).string();
}

}  // namespace talus::verification
