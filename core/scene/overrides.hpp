#pragma once

#include "scene/mistakes.hpp"
#include "scene/positions.hpp"

namespace talus {

/// Writes the --set values into the scene, in their order. An object that a pointer leads through is
/// made where the scene leaves it out and may have it; any other parent that does not exist is a mistake.
void apply_overrides(Json& scene, const std::vector<Override>& overrides, Mistakes& mistakes);

}  // namespace talus
