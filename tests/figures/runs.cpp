#include "figures/runs.hpp"

namespace talus::figures {

Registry& registry() {
  static Registry all = [] {
    Registry made;
    const std::filesystem::path folder = TALUS_PLUGINS;
    load_folders(made, {&folder, 1});
    return made;
  }();
  return all;
}

Scene shipped(const std::string& name, const std::vector<Override>& overrides) {
  return read_scene(std::filesystem::path(TALUS_SCENES) / (name + ".json"), registry(), {overrides});
}

Scene from_text(const std::string& text, const std::vector<Override>& overrides) {
  return read_scene_text(text, "scene.json", registry(), {overrides});
}

}  // namespace talus::figures
