#pragma once

#include "scene/loops.hpp"

namespace talus {

/// "mesh" of a body: loops, surface names and triangles from the file. Returns whether the loops can be
/// looked at; notes mistakes.
bool read_mesh_shape(Reading& reading, Section& body, Shape& shape);

}  // namespace talus
