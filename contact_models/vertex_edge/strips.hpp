#pragma once

#include "vertex.hpp"

#include <cstdint>

namespace talus::vertex_edge {

/// Cosine of the angle from which on two sides are at right angles.
inline constexpr double upright = 0.1;

/// Tangent of the side that meets a strip's own in its corner `v`, 0 or 1: the strip ends there along the
/// bisector of the two. That of its own side where it has no width.
inline Point tangent_beyond(const Piece& strip, std::uint32_t v) {
  const Point own = strip.tangent(0);
  const std::uint32_t edge = v == 0 ? strip.previous(0) : 1;
  if (!(strip.length(edge) > 0)) return own;
  const Point bisector = strip.tangent(edge);
  return own - 2 * dot(bisector, own) * bisector;
}

}  // namespace talus::vertex_edge
