#pragma once

namespace talus::benchmarks {

/// Time from the text of a scene to its first step.
void register_setups();

}  // namespace talus::benchmarks
