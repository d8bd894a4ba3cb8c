#pragma once

#include "verification/bench.hpp"

#include <string>

namespace talus::verification {

/// A bar of 10 × 0.5 m about the origin, E = 1e10 Pa, ν = 0 and 2300 kg/m³, that is let go in the shape of
/// its first longitudinal mode. `shape`: members of the body, with surfaces "top" and "bottom".
Scene free_bar(const Bench& bench, const std::string& cover, const std::string& shape);

/// Of that mode, from the zeros of its share in the motion, Hz.
double first_frequency(const Scene& scene);

}  // namespace talus::verification
