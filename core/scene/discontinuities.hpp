#pragma once

#include "scene/reading.hpp"

#include <string>
#include <vector>

namespace talus {

/// "discontinuities" of a body: polylines along which it is cut. Appends the name of the surface of each, or
/// "", to `surfaces`.
std::vector<Discontinuity> read_discontinuities(Section& body, std::vector<std::string>& surfaces);

/// The same list under another key: "joints" of a generator of blocks.
std::vector<Discontinuity> read_polylines(Section& section, const std::string& key,
                                          std::vector<std::string>& surfaces);

/// "surface" of lines: the name of their faces, or "".
std::string read_line_surface(Section& line);

}  // namespace talus
