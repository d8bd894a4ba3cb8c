#include "scene/source.hpp"

#include "files/whole_file.hpp"
#include "scene/mistakes.hpp"
#include "scene/positions.hpp"

#include <utility>

namespace talus {

SceneError error_of(const Scene& scene, const std::vector<RefusedBody>& refused) {
  if (scene.source == nullptr || !std::filesystem::is_regular_file(scene.file)) {
    std::vector<Mistake> mistakes;
    for (const RefusedBody& body : refused)
      mistakes.push_back({scene.file, 0, 0, below("/bodies", body.body), body.words});
    return SceneError(std::move(mistakes));
  }
  Mistakes mistakes;
  for (const RefusedBody& body : refused)
    mistakes.add(scene.source->expansion.origin_of(below("/bodies", body.body)), body.words);
  return mistakes.placed(read_whole_file(scene.file), scene.file, scene.source->overrides, {});
}

}  // namespace talus
