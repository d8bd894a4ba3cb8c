#pragma once

#include "scene/reading.hpp"

namespace talus {

/// "loads": forces on points of bodies.
void read_loads(Reading& reading, Section& root);

/// "prescribed": motion of named surfaces.
void read_prescribed(Reading& reading, Section& root);

}  // namespace talus
