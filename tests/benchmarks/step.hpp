#pragma once

namespace talus::benchmarks {

/// Names of cases that run for minutes begin so; they run where a filter asks for them.
inline constexpr const char* large = "large/";

/// Time per block and step.
void register_steps();

}  // namespace talus::benchmarks
