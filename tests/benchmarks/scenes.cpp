#include "scenes.hpp"

#include "scene/read.hpp"

#include <array>
#include <cstdio>
#include <stdexcept>

namespace talus::benchmarks {
namespace {

Registry& registry() {
  static Registry shipped = [] {
    Registry all;
    load_folders(all, std::array{std::filesystem::path(TALUS_PLUGINS)});
    return all;
  }();
  return shipped;
}

}  // namespace

std::string generated(const std::string& generator) {
  const std::string command = "'" TALUS_PYTHON "' '" TALUS_SCENES "'/generate/" + generator;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("could not start: " + command);
  std::string text;
  char part[65536];
  for (std::size_t got; (got = fread(part, 1, sizeof part, pipe)) > 0;) text.append(part, got);
  if (pclose(pipe) != 0) throw std::runtime_error("failed: " + command);
  return text;
}

Scene scene_of_text(const std::string& text) {
  return read_scene_text(text, "benchmark", registry());
}

Scene scene_of(const Load& load) {
  ReadOptions options;
  options.overrides = {{"/contact/model", load.law}};
  if (load.sleep) options.overrides.push_back({"/sleep", "{}"});
  if (!load.cover.empty()) options.overrides.push_back({"/cover", load.cover});
  Scene scene = read_scene_text(generated(load.generator), load.generator, registry(), options);
  scene.time.end = 1000;
  scene.output.frames.reset();
  if (load.one_sided) {
    scene.roles_by_priority = true;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) scene.bodies[i].priority = static_cast<double>(i);
  }
  return scene;
}

}  // namespace talus::benchmarks
