#pragma once

#include "corner_contacts.hpp"

#include <algorithm>
#include <vector>

namespace talus::vertex_edge {

/// Whether the boundary goes on from the side of `p` to that of `q` where it bends inwards.
inline bool leads(std::span<const PiecePairGeometry> pieces, const CornerContact& p, const CornerContact& q) {
  const Piece &from = pieces[p.entry].piece[1 - p.vertex_body],
              &to = pieces[q.entry].piece[1 - q.vertex_body];
  if (from.is_strip() || to.is_strip()) return false;  // under load they bend at every corner
  const double near = 1e-9 * std::min(from.length(p.side), to.length(q.side));
  return length(from.at(from.next(p.side)) - to.at(q.side)) <= near &&
         cross(from.tangent(p.side), to.tangent(q.side)) < 0 &&
         dot(from.tangent(p.side), to.tangent(q.side)) < straight;
}

inline bool in_reflex_corner(std::span<const PiecePairGeometry> pieces, const CornerContact& p,
                             const CornerContact& q) {
  return leads(pieces, p, q) || leads(pieces, q, p);
}

/// Behind one straight line the depths differ by rounding alone: there the vertex stands where its foot is.
inline bool is_nearer(const CornerContact& contact, const CornerContact& other) {
  const auto beside = [](const CornerContact& one) { return std::max({0.0, -one.lever, one.lever - 1}); };
  if (std::abs(contact.depth - other.depth) > 1e-9 * contact.tributary) return contact.depth < other.depth;
  return beside(contact) < beside(other);
}

/// Past a cut a vertex stands in the reflex corner where that begins, and nowhere else: on its other face,
/// too, and within the body.
inline bool stands_past_cut(std::span<const PiecePairGeometry> pieces, const CornerContact& contact,
                            const std::vector<CornerContact>& found) {
  const std::uint32_t met = 1 - contact.vertex_body;
  const Point at = pieces[contact.entry].piece[contact.vertex_body].at(contact.vertex);
  const auto holds = [&](const PiecePairGeometry& pair) {
    const Piece& piece = pair.piece[met];
    for (std::uint32_t k = 0; k < piece.size(); ++k) {
      if (piece.depth(k, at) < -contact.slack) return false;
    }
    return true;
  };
  return std::ranges::any_of(found,
                             [&](const CornerContact& other) {
                               return other.key == contact.key && in_reflex_corner(pieces, contact, other);
                             }) &&
         std::ranges::any_of(pieces, holds);
}

/// A vertex on the cut between two pieces of a body stands on one of them only, where it is less deep, and
/// on the sides that reflex corners lead to from there.
inline void drop_repeated(std::span<const PiecePairGeometry> pieces, std::vector<CornerContact>& found) {
  std::erase_if(found, [&](const CornerContact& contact) {
    return contact.past_cut && !stands_past_cut(pieces, contact, found);
  });
  for (auto contact = found.begin(); contact != found.end(); ++contact) {
    const auto nearest = std::find_if(found.begin(), contact, [&](const CornerContact& other) {
      return other.stands && other.key == contact->key;
    });
    contact->stands = nearest == contact || is_nearer(*contact, *nearest);
    if (contact->stands && nearest != contact) nearest->stands = false;
  }
  const auto led_to = [&](const CornerContact& contact) {
    return !contact.stands && std::ranges::any_of(found, [&](const CornerContact& other) {
      return other.stands && other.key == contact.key && in_reflex_corner(pieces, contact, other);
    });
  };
  for (auto next = found.begin(); next != found.end();) {
    next = std::ranges::find_if(found, led_to);
    if (next != found.end()) next->stands = true;
  }
  std::erase_if(found, [](const CornerContact& contact) { return !contact.stands; });
}

}  // namespace talus::vertex_edge
