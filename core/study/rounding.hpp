#pragma once

#include "scene/scene.hpp"

#include <string_view>

namespace talus {

/// What a motion of a scene may be by rounding alone, in the unit of its column ("A.vx [m/s]"): 1e-12 of the
/// extent of all bodies or of a radian, and of that over the time of the run. 0 for what is no motion.
double rounding_of(const Scene& scene, std::string_view column);

}  // namespace talus
