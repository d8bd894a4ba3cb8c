#pragma once

#include "geometry/loop.hpp"

#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

namespace talus {

/// A side of a convex piece: from `at` to the next corner.
struct PieceCorner {
  Vec2 at;
  std::uint32_t surface;  ///< surface class, or internal_side along a cut
  std::uint32_t cut;      ///< number of the cut, for internal sides
};

using ConvexPiece = std::vector<PieceCorner>;  ///< counter-clockwise

/// A body that rounding keeps from being cut, in words that say near which point.
class Indivisible : public std::runtime_error {
 public:
  explicit Indivisible(Vec2 at);
};

/// Cuts a body into convex pieces along the inner bisectors of its reflex vertices, so that the distance to
/// the nearest side is continuous across each cut near its vertex. Where bisectors cross, that from the
/// vertex nearest to the side ahead goes through. A convex body is its own only piece. Throws Indivisible
/// where features of the body are as small as rounding.
std::vector<ConvexPiece> convex_pieces(const Loop& outer, std::span<const Loop> holes);

}  // namespace talus
