#pragma once

#include <talus/contact_model.hpp>

namespace talus {

/// How far all sides of a convex ring of `count` corners can move inwards before the first of them vanishes,
/// m. Until then a point is nearest to the side whose neighbours' bisectors it lies between. Infinite for a
/// ring that never loses one.
double vanishing_depth(const BoundaryCorner* ring, std::size_t count);

}  // namespace talus
