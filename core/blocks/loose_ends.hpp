#pragma once

#include "blocks/cut.hpp"

#include <vector>

namespace talus {

/// The ends of drawn lines that lie within a face, further than `margin` (m) from all that bounds it: from
/// the last line that they cross on they cut nothing. In the order of the lines, the first few thousand.
std::vector<LooseEnd> loose_ends(const std::vector<Cut>& cuts, const std::vector<Block>& faces,
                                 double margin);

}  // namespace talus
