#pragma once

#include "scene/reading.hpp"

#include <span>
#include <vector>

namespace talus {

/// "loads": forces on points of bodies.
void read_loads(Reading& reading, Section& root);

/// "surface_loads": tractions and pressures on named surfaces.
void read_surface_loads(Reading& reading, Section& root);

/// "absorbing": named surfaces that let plane waves out.
void read_absorbing(Reading& reading, Section& root);

/// "prescribed": motion of named surfaces.
void read_prescribed(Reading& reading, Section& root);

/// Supports of a stage go on from where those of the stage before have come to by its time, s.
void continue_prescribed(std::vector<PrescribedSurface>& supports, std::span<const PrescribedSurface> before,
                         double from);

}  // namespace talus
