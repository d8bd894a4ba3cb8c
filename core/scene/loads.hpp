#pragma once

#include "scene/reading.hpp"

namespace talus {

/// "loads": forces on points of bodies.
void read_loads(Reading& reading, Section& root);

/// "surface_loads": tractions and pressures on named surfaces.
void read_surface_loads(Reading& reading, Section& root);

/// "absorbing": named surfaces that let plane waves out.
void read_absorbing(Reading& reading, Section& root);

/// "prescribed": motion of named surfaces.
void read_prescribed(Reading& reading, Section& root);

}  // namespace talus
