#pragma once

#include "scene/reading.hpp"

namespace talus {

/// "settle", "time", "sleep", "output", "limits": when things happen and when a run stops.
/// "damping" of the root and of "settle" are a number, "adaptive" or "kinetic".
void read_damping(Reading& reading, Section& root);
void read_settle(Reading& reading, Section& root);
void read_time(Reading& reading, Section& root);  ///< after the interfaces
void read_sleep(Reading& reading, Section& root);
void read_output(Reading& reading, Section& root);  ///< after the time
void read_limits(Reading& reading, Section& root);

}  // namespace talus
