#pragma once

#include "scene/mistakes.hpp"
#include "scene/positions.hpp"

namespace talus {

/// Writes the --set values into the scene, in their order. A pointer whose parent does not exist is a
/// mistake.
void apply_overrides(Json& scene, const std::vector<Override>& overrides, Mistakes& mistakes);

}  // namespace talus
