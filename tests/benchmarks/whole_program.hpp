#pragma once

namespace talus::benchmarks {

/// `talus run` from the file of a scene to the end, its output included.
void register_whole_programs();

}  // namespace talus::benchmarks
