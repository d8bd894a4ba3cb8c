#pragma once

#include "vertex.hpp"

#include <algorithm>
#include <cstdint>
#include <span>

namespace talus::vertex_edge {

/// A vertex of one body against a side of the other.
struct CornerContact {
  std::uint32_t entry;        ///< which piece pair of the pair
  std::uint32_t vertex_body;  ///< 0: the vertex belongs to body a, 1: to body b
  std::uint32_t vertex;       ///< corner of its piece
  std::uint32_t key;          ///< the vertex, known again at the next step
  std::uint32_t side;         ///< of the other body's piece
  double depth;               ///< m, behind the side; negative across an intact bond
  double lever;               ///< foot of the vertex along the side, 0 to 1 on it
  double tributary;           ///< m, length of boundary whose load the vertex carries
  double filled;        ///< share of half of force times depth that its spring holds: less than 1 where the
                        ///< tributary grows with the depth
  double lent;          ///< m, what the other face of a reflex corner lends to that length
  double slack;         ///< m, how far past the end of the side the vertex may be and still stand on it
  double share;         ///< of its spring: half where two corners that bear alike meet on each other's edges,
                        ///< see also `share_in_corner`; else 1
  bool meets_corner;    ///< two corners meet, and each stands on the other's edge
  bool past_cut;        ///< past the cut at the end of the side, where its piece cannot see it any more
  bool stands;          ///< on this side, not only on others that the same vertex was found at
  bool idle;            ///< neither of the sides of its body that meet in it faces the side
  bool bonded;          ///< by what has not broken yet
  Point before, after;  ///< tangents of the edges that meet in the vertex
};

inline const Piece& own_piece(std::span<const PiecePairGeometry> pieces, const CornerContact& contact) {
  return pieces[contact.entry].piece[contact.vertex_body];
}

/// The piece whose side it stands on.
inline const Piece& other_piece(std::span<const PiecePairGeometry> pieces, const CornerContact& contact) {
  return pieces[contact.entry].piece[1 - contact.vertex_body];
}

/// By which the side is known again at the next step.
inline double side_number(std::span<const PiecePairGeometry> pieces, const CornerContact& contact) {
  return other_piece(pieces, contact).first_corner() + contact.side;
}

/// How far above a side a vertex still stands on it, m: held by a bond, and with what a step may have torn
/// that off, so that it is seen to break.
struct BondReach {
  double held, seen;
  bool intact = false;
};

/// Share of its edges by which a corner may stand past the end of an edge and still be carried by it.
inline constexpr double flush = 0.01;

/// Share of a side of a body of many elements up to which its ends are near by another side.
inline constexpr double near_by = 0.1;

/// Sine of the angle from which on an edge does not lie flat on a side, and from which on it goes into it: 10
/// degrees.
inline constexpr double leaning = 0.17;

/// m, up to how deep behind a side the end of another counts as on it, though a flank is nearer. Lattices cut
/// off sides shorter than any overlap, so that of the side below counts as well.
inline double shallow(double own, double met) {
  return near_by * std::max(own, met / 2);
}

}  // namespace talus::vertex_edge
