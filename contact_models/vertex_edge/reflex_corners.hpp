#pragma once

#include "corner_contact.hpp"
#include "springs.hpp"
#include "tributary.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace talus::vertex_edge {

/// Whether the boundary goes on from the side of `p` to that of `q` where it bends inwards.
inline bool leads(std::span<const PiecePairGeometry> pieces, const CornerContact& p, const CornerContact& q) {
  const Piece &from = other_piece(pieces, p), &to = other_piece(pieces, q);
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

/// m, how far a vertex is past that end of its side where the boundary leads on to another, or from it.
inline double past_end(std::span<const PiecePairGeometry> pieces, const CornerContact& contact,
                       bool leads_on) {
  const Piece& side_of = other_piece(pieces, contact);
  return side_of.length(contact.side) * (leads_on ? contact.lever - 1 : -contact.lever);
}

/// How flat an edge lies on a side, cos 2β of the angle between them; 0 from 45° on.
inline double flatness(Point edge, Point side) {
  const double cosine = -dot(edge, side);
  return cosine > 0 ? std::clamp(2 * cosine * cosine - 1, 0.0, 1.0) : 0;
}

/// How much of its spring a vertex has on one face of a reflex corner, what part of that the corner holds,
/// and how far that is inside the wedge between the normals: 1 but for its last quarter.
struct CornerShare {
  double all = 1, of_corner = 0, inside = 0;
};

/// On the one face, `p`, beside the other, `q`. A vertex is held by the nearest point of the boundary, with
/// ½ k d² at d from that: of the face in front of which it is or, in the wedge between their normals, of the
/// corner. There d = a_p n_p + a_q n_q, and a_p is how far the vertex is past the end of q, over the sine of
/// the turn. As far as an edge of its own lies flat on each face, and in a right or an acute angle, it stands
/// on both.
inline CornerShare share_in_corner(std::span<const PiecePairGeometry> pieces, const CornerContact& p,
                                   const CornerContact& q) {
  // Not the ends of strips: with shares a block of many elements that slid over bends of 10° missed 2.9 % of
  // its energy, without them 0.02 %.
  if (own_piece(pieces, p).is_strip()) return {};
  const bool leads_on = leads(pieces, p, q);
  if (!(leads_on || leads(pieces, q, p)) || !(p.depth > 0 && q.depth > 0)) return {};
  const Point along_p = other_piece(pieces, p).tangent(p.side),
              along_q = other_piece(pieces, q).tangent(q.side);
  if (!(dot(along_p, along_q) > 0)) return {};
  const double past_q = past_end(pieces, q, !leads_on);
  const double nearest = std::clamp(past_q / (std::abs(cross(along_p, along_q)) * p.depth), 0.0, 1.0);
  const double beside = std::max(flush * q.tributary, q.depth);
  const double both = flatness(p.after, leads_on ? along_p : along_q) *
                      flatness(p.before, leads_on ? along_q : along_p) *
                      std::clamp(2 + past_q / beside, 0.0, 1.0);
  const double all = both + (1 - both) * nearest;
  if (!(all > 0)) return {0, 0, 0};
  return {all, (1 - both) * nearest / all, std::min(1.0, 4 * (1 - nearest))};
}

/// m, what a vertex was lent on the side that it stands on.
inline double lent_before(std::span<const PiecePairGeometry> pieces, const std::vector<SpringHistory>& old,
                          const CornerContact& contact) {
  const double side = side_number(pieces, contact);
  const auto own = std::ranges::find_if(old, [&](const SpringHistory& history) {
    return history.key == 1.0 + contact.key && history.side == side;
  });
  return own != old.end() ? own->lent : 0;
}

/// m, over which what a vertex was lent goes as it moves away from the corner along the face.
inline double lending_reach(std::span<const PiecePairGeometry> pieces, const CornerContact& contact) {
  const Piece &own = own_piece(pieces, contact), &other = other_piece(pieces, contact);
  const std::uint32_t edge = flatter_edge(own, contact.vertex, other.tangent(contact.side));
  return least_tributary(own.length(edge), other.length(contact.side));
}

inline double still_lent(std::span<const PiecePairGeometry> pieces, const CornerContact& contact) {
  const double from_corner = other_piece(pieces, contact).length(contact.side) *
                             std::max(0.0, std::min(contact.lever, 1 - contact.lever));
  return contact.lent * std::max(0.0, 1 - from_corner / lending_reach(pieces, contact));
}

/// Whether a vertex is so little deep that its spring may change at once: what that holds is nothing beside
/// what it will.
inline bool only_touches(std::span<const PiecePairGeometry> pieces, const CornerContact& contact) {
  return contact.depth < 2e-3 * lending_reach(pieces, contact);
}

/// Of a vertex that is found on both faces of a reflex corner. What the corner holds goes by the longer of
/// the stretches that its edge faces of the two, as far as the edge lies flat there; a tip faces none. What
/// that adds comes as the vertex enters the wedge between the normals, all at once where it only touches, and
/// goes far slower: a spring that changes within its own depth would drive a vertex that trembles there.
inline void share_corners(std::span<const PiecePairGeometry> pieces, const std::vector<SpringHistory>& old,
                          std::vector<CornerContact>& found) {
  for (CornerContact& contact : found) {
    const double before = lent_before(pieces, old, contact);
    bool in_corner = false;
    for (const CornerContact& other : found) {
      if (other.key != contact.key || &other == &contact) continue;
      const CornerShare share = share_in_corner(pieces, contact, other);
      contact.share *= share.all;
      if (!(share.of_corner > 0)) continue;
      const Point along = other_piece(pieces, other).tangent(other.side);
      const double flat = std::max(flatness(other.before, along), flatness(other.after, along));
      const double most = share.of_corner * flat * std::max(0.0, other.tributary - contact.tributary);
      const double at_once = only_touches(pieces, contact) ? most : std::min(before, most);
      contact.lent = std::max({contact.lent, share.inside * most, at_once});
      in_corner = true;
    }
    if (!in_corner) contact.lent = before;
  }
  std::erase_if(found, [](const CornerContact& contact) { return contact.share == 0; });
  for (CornerContact& contact : found) {
    if (!(contact.lent > 0)) continue;
    const double left = still_lent(pieces, contact);
    contact.tributary += left;
    if (left == 0) contact.lent = 0;
  }
}

/// Whether two sides of a body of many elements may be one that has bent under its load.
inline bool bends_little(const Piece& p, const Piece& q) {
  constexpr double cosine = 0.9;
  return p.is_strip() && q.is_strip() && dot(p.tangent(0), q.tangent(0)) > cosine;
}

/// Behind one straight line, and one that has bent inwards under load, the vertex stands where its foot is.
/// Where it bears nothing it does not stand if there is another side near by.
inline bool is_nearer(std::span<const PiecePairGeometry> pieces, const CornerContact& contact,
                      const CornerContact& other) {
  if (contact.idle != other.idle) {
    const CornerContact& bears = contact.idle ? other : contact;
    const Piece &own = own_piece(pieces, bears), &met = other_piece(pieces, bears);
    if (bears.depth <= shallow(own.length(0), met.length(bears.side))) return other.idle;
  }
  const auto beside = [](const CornerContact& one) { return std::max({0.0, -one.lever, one.lever - 1}); };
  const double apart = beside(contact) - beside(other);
  if (apart != 0 && bends_little(other_piece(pieces, contact), other_piece(pieces, other))) return apart < 0;
  if (std::abs(contact.depth - other.depth) > 1e-9 * contact.tributary) return contact.depth < other.depth;
  return apart < 0;
}

/// Past a cut a vertex stands in the reflex corner where that begins, and nowhere else: on its other face,
/// too, and within the body.
inline bool stands_past_cut(std::span<const PiecePairGeometry> pieces, const CornerContact& contact,
                            const std::vector<CornerContact>& found) {
  const std::uint32_t met = 1 - contact.vertex_body;
  const Point at = own_piece(pieces, contact).at(contact.vertex);
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
inline void drop_repeated(std::span<const PiecePairGeometry> pieces, const std::vector<SpringHistory>& old,
                          std::vector<CornerContact>& found) {
  std::erase_if(found, [&](const CornerContact& contact) {
    return contact.past_cut && !stands_past_cut(pieces, contact, found);
  });
  share_corners(pieces, old, found);
  for (auto contact = found.begin(); contact != found.end(); ++contact) {
    const auto nearest = std::find_if(found.begin(), contact, [&](const CornerContact& other) {
      return other.stands && other.key == contact->key;
    });
    contact->stands = nearest == contact || is_nearer(pieces, *contact, *nearest);
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
