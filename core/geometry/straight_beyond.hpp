#pragma once

#include <talus/contact_model.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace talus {

/// Boundaries::straight_beyond of a body of one element that is cut into pieces: [4 * corner]. Corners of
/// `piece_start`, which has one entry more than there are pieces, count from its first.
std::vector<double> straight_beyond(std::span<const BoundaryCorner> corners,
                                    std::span<const std::uint32_t> piece_start);

}  // namespace talus
