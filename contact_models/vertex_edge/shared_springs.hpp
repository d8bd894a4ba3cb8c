#pragma once

// Contacts of one pair of pieces that bear the same: two corners on each other's edges, and a corner beside
// the ends of a strip.

#include "tributary.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace talus::vertex_edge {

/// Corners that meet: one is past the end of its side where the other is, so that it stands there by its
/// slack alone; or they are no further along the sides than they are deep, or than bonds reach that hold
/// both.
inline bool mutual(const PiecePairGeometry& geometry, const CornerContact& p, const CornerContact& q) {
  if (p.past_cut || q.past_cut) return false;  // it stands on the other face of a reflex corner, or nowhere
  if (p.vertex_body == q.vertex_body || geometry.piece[0].is_strip() || geometry.piece[1].is_strip())
    return false;
  const auto at_start = [&](const CornerContact& contact, const CornerContact& other) {
    return contact.side == other.vertex;
  };
  const auto at_end = [&](const CornerContact& contact, const CornerContact& other) {
    return geometry.piece[1 - contact.vertex_body].next(contact.side) == other.vertex;
  };
  const auto past = [&](const CornerContact& contact, const CornerContact& other) {
    return (contact.lever < 0 && at_start(contact, other)) || (contact.lever > 1 && at_end(contact, other));
  };
  const auto near = [&](const CornerContact& contact, const CornerContact& other) {
    const Piece& piece = geometry.piece[1 - contact.vertex_body];
    const Point apart = geometry.piece[0].at(contact.vertex_body == 0 ? contact.vertex : other.vertex) -
                        geometry.piece[1].at(contact.vertex_body == 1 ? contact.vertex : other.vertex);
    const double along = std::abs(dot(apart, piece.tangent(contact.side)));
    return along <= std::max({contact.depth, other.depth, contact.slack, other.slack});
  };
  const auto ends_at = [&](const CornerContact& contact, const CornerContact& other) {
    return at_start(contact, other) || at_end(contact, other);
  };
  if (!ends_at(p, q) || !ends_at(q, p)) return false;
  return past(p, q) || past(q, p) || (near(p, q) && near(q, p));
}

/// Lets corners that stand on each other's edges share a spring, among contacts from `first` on.
inline void share_springs(const PiecePairGeometry& geometry, std::vector<CornerContact>& found,
                          std::size_t first) {
  for (std::size_t i = first; i < found.size(); ++i) {
    for (std::size_t j = i + 1; j < found.size(); ++j) {
      if (!mutual(geometry, found[i], found[j])) continue;
      // One that bears next to nothing is no half of the other.
      const double more = std::max(found[i].tributary, found[j].tributary),
                   alike = more > 0 ? std::min(found[i].tributary, found[j].tributary) / more : 1;
      found[i].share = found[j].share = 1 - alike * alike / 2;
      found[i].meets_corner = found[j].meets_corner = true;
    }
  }
}

/// Between a body of many elements and one piece both the ends of a side and the corners above it bear,
/// each half of what faces the other. Where both ends stand they bear the whole side, and a corner flush
/// with one of them no more than keeps it known.
inline void leave_to_ends(const PiecePairGeometry& geometry, std::vector<CornerContact>& found,
                          std::size_t first) {
  const auto of_strip = [&](std::uint32_t body) { return geometry.piece[body].is_strip(); };
  if (of_strip(0) == of_strip(1)) return;
  const auto start = found.begin() + static_cast<std::ptrdiff_t>(first);
  const auto ends = std::count_if(
      start, found.end(), [&](const CornerContact& contact) { return of_strip(contact.vertex_body); });
  if (ends < 2) return;
  for (auto contact = start; contact != found.end(); ++contact) {
    const std::uint32_t body = contact->vertex_body;
    if (of_strip(body)) continue;
    const Piece &own = geometry.piece[body], &other = geometry.piece[1 - body];
    const std::uint32_t edge = flatter_edge(own, contact->vertex, other.tangent(contact->side));
    contact->tributary = least_tributary(own.length(edge), other.length(contact->side));
    contact->filled = 1;
  }
}

}  // namespace talus::vertex_edge
