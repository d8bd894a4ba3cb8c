#pragma once

#include "simulation/simulation.hpp"

#include <string>

namespace talus {

/// What a scene is before anything moves, as an SVG: bodies with their covers, joints, named surfaces,
/// supports, loads, first velocities, monitors and gravity. Names stand where there is room for them.
std::string scene_svg(const Simulation& simulation);

}  // namespace talus
