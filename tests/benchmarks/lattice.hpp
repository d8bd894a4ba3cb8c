#pragma once

namespace talus::benchmarks {

void register_lattices();

}  // namespace talus::benchmarks
