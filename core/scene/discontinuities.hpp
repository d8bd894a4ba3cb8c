#pragma once

#include "scene/reading.hpp"

#include <string>
#include <vector>

namespace talus {

/// "discontinuities" of a body: polylines along which it is cut. Appends the name of the surface of each, or
/// "", to `surfaces`.
std::vector<Discontinuity> read_discontinuities(Section& body, std::vector<std::string>& surfaces);

}  // namespace talus
