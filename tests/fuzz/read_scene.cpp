#include "targets.hpp"

#include "scene/read.hpp"
#include "scene/sample.hpp"

#include <fmt/format.h>

namespace talus::fuzz {

namespace {

/// The blocks of a generator are a matter of time, not of bytes.
ReadOptions few_blocks() {
  ReadOptions options;
  options.most_blocks = 300;
  return options;
}

/// As a user sees it: a place in the text, and words that a terminal can show.
void check_mistakes(const SceneError& error) {
  demand(!error.mistakes.empty(), "refused without a mistake");
  for (const Mistake& mistake : error.mistakes) {
    demand(mistake.line > 0 && mistake.column > 0, "a mistake without a place");
    demand(!mistake.message.empty(), "a mistake without words");
    demand(mistake.message.size() < 20'000, fmt::format("a message of {} bytes", mistake.message.size()));
  }
}

}  // namespace

void read_scene(std::string_view bytes) {
  static Registry registry = sample::registry();
  Scene scene;
  try {
    scene = read_scene_text(std::string(bytes), "scene.json", registry, few_blocks());
  } catch (const SceneError& error) {
    check_mistakes(error);
    return;
  }
  try {
    const Scene again = read_scene_text(scene.resolved, "resolved.json", registry, few_blocks());
    demand(again.resolved == scene.resolved, "a resolved scene is not what it resolves to");
    plain_scene_text(std::string(bytes), "scene.json", registry, few_blocks());
  } catch (const SceneError& error) {
    demand(false, fmt::format("a resolved scene is refused: {}", error.what()));
  }
}

}  // namespace talus::fuzz
