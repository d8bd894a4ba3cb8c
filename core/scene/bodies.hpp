#pragma once

#include "scene/reading.hpp"

namespace talus {

/// "cover" and "bodies". Surface classes of the edges are given out later, by number_surfaces().
void read_bodies(Reading& reading, Section& root);

}  // namespace talus
