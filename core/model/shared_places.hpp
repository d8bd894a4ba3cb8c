#pragma once

#include "model/partition.hpp"

#include <cstdint>
#include <vector>

namespace talus {

/// Gives rows of patches of a subdomain the places of rows that are done by then, so that what is worked on
/// stays in the nearest cache. `starts`: the numbers in the subdomain that rows start with, ascending, and
/// the end.
void share_places(Partition& partition, Subdomain& subdomain, std::vector<std::uint32_t> starts);

}  // namespace talus
