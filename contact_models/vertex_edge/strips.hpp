#pragma once

#include "vertex.hpp"

#include <cstdint>

namespace talus::vertex_edge {

/// Cosine of the angle from which on two sides are at right angles.
inline constexpr double upright = 0.1;

/// The side of a strip along the bisector in which it ends at its corner `v`, 0 or 1. Where the bisector was
/// cut off at the corner itself, that is what goes on from there.
inline std::uint32_t bisector_at(const Piece& strip, std::uint32_t v) {
  std::uint32_t edge = v == 0 ? strip.previous(0) : 1;
  while (edge != 0 && !(strip.length(edge) > 0)) edge = v == 0 ? strip.previous(edge) : strip.next(edge);
  return edge;
}

/// Tangent of the side that a bisector divides a strip's own from.
inline Point tangent_across(const Piece& strip, std::uint32_t bisector) {
  const Point own = strip.tangent(0), along = strip.tangent(bisector);
  return own - 2 * dot(along, own) * along;
}

/// Tangent of the side that meets a strip's own in its corner `v`.
inline Point tangent_beyond(const Piece& strip, std::uint32_t v) {
  return tangent_across(strip, bisector_at(strip, v));
}

}  // namespace talus::vertex_edge
