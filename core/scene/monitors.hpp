#pragma once

#include "scene/reading.hpp"

namespace talus {

/// "monitors": what is recorded of which body or point.
void read_monitors(Reading& reading, Section& root);

/// "tolerances": how far runs may part at these monitors.
void read_tolerances(Reading& reading, Section& root);

}  // namespace talus
