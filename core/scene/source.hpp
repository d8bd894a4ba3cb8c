#pragma once

#include "scene/blocks.hpp"
#include "scene/read.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace talus {

/// What came between the file of a scene and its bodies. What is wrong with a body may show only when it is
/// built.
struct SceneSource {
  std::vector<Override> overrides;
  Expansion expansion;
};

/// A body that cannot have what the scene asks for, in words for the user.
struct RefusedBody {
  std::uint32_t body;
  std::string words;
};

/// The same as mistakes of the scene, at the bodies or at what generated them: the file is read once more to
/// find the places. A scene that came from no file, or from a pipe, has its bodies named without.
SceneError error_of(const Scene& scene, const std::vector<RefusedBody>& refused);

}  // namespace talus
