#pragma once

#include "scene/reading.hpp"

namespace talus {

/// "materials": a density each, and a model with its parameters where one is named.
void read_materials(Reading& reading, Section& root);

}  // namespace talus
