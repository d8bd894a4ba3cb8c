#pragma once

#include "safety/safety.hpp"

#include <string>

namespace talus {

/// How a scene fails at the least factor that it fell at, as an SVG: what moves by colour and arrow, in the
/// place where it stood. "" where no run fell of itself.
std::string mechanism_svg(const Scene& scene, const Safety& safety);

}  // namespace talus
