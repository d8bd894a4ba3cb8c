#pragma once

#include "blocks/line_ends.hpp"

#include <vector>

namespace talus {

/// The ends of drawn lines that lie within a face and further than `reach` (m) from all other lines, those
/// that bound no face as well: from the last line that they cross on they cut nothing. In the order of the
/// lines.
std::vector<LooseEnd> loose_ends(const std::vector<LineEnd>& ends, const std::vector<Block>& faces,
                                 const SidesByPlace& sides, double reach);

}  // namespace talus
