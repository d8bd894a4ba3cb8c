#pragma once

namespace talus::benchmarks {

/// What it costs that laws stand behind an interface.
void register_interface();

}  // namespace talus::benchmarks
