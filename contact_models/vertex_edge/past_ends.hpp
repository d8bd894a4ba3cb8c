#pragma once

// Vertices past the end of the side that they stand on: beside a tip, or at a cut.

#include "corner_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

namespace talus::vertex_edge {

/// An edge beside a side, and how far past it a vertex is, m; negative: behind it.
struct Bound {
  Point normal{0, 0};
  double past = 0;
};

/// Of the corners at the ends of a side that point outward, and in which a cut of the body ends, the edges
/// that other pieces have.
inline std::array<Bound, 2> tips_at_cuts(std::span<const PiecePairGeometry> pieces, const Piece& other,
                                         const CornerContact& contact, Point at) {
  std::array<Bound, 2> bounds;
  if (other.is_strip()) return bounds;
  const std::uint32_t start = contact.side, end = other.next(contact.side);
  for (const std::uint32_t corner : {start, end}) {
    if (!other.is_cut(corner == start ? other.previous(start) : end)) continue;
    const std::optional<Vertex> tip = Vertices(pieces, 1 - contact.vertex_body).at(other, corner);
    if (!tip) continue;
    const Point along = corner == start ? tip->before : tip->after, normal{along.y, -along.x};
    bounds[corner == start ? 0 : 1] = {normal, dot(at - other.at(corner), normal)};
  }
  return bounds;
}

/// A vertex that is past the end of its side bears only where an edge of its own goes on into the other
/// body: by how deep that comes in, over its own depth. At a sharp tip it does not come in at all.
inline double share_that_bears(const Piece& own, const Piece& other, const Vertex& vertex,
                               const CornerContact& contact, const std::array<Bound, 2>& tips) {
  const std::uint32_t v = contact.vertex;
  const Point at = own.at(v), edges[] = {-1.0 * vertex.before, vertex.after};
  const double lengths[] = {vertex.divided ? vertex.shorter : own.length(own.previous(v)),
                            vertex.divided ? vertex.shorter : own.length(v)};
  double least = 1;
  const auto lessen = [&](const Bound& bound) {
    if (!(bound.past > 0)) return;
    double most = 0;
    for (int i = 0; i < 2; ++i) {
      const double inward = -dot(edges[i], bound.normal);
      if (!(inward * lengths[i] > bound.past)) continue;
      const double depth = other.depth(contact.side, at + bound.past / inward * edges[i]);
      most = std::max(most, std::min(1.0, depth / contact.depth));
    }
    least = std::min(least, most);
  };
  for (std::uint32_t k = 0; k < other.size(); ++k) {
    if (k != contact.side && other.real(k)) lessen({other.normal(k), -other.depth(k, at)});
  }
  for (const Bound& tip : tips) lessen(tip);
  return least;
}

/// Whether a vertex at the cut of a piece, not flush with the end of its side, is before a side that faces
/// it of the piece beyond: where a cut ends near a corner, the one sees the far side, the other the near.
inline bool is_before_another(std::span<const PiecePairGeometry> pieces, Point at, Point outward,
                              const CornerContact& contact) {
  const double touching = 1e-6 * contact.depth;
  const std::uint32_t met = 1 - contact.vertex_body;
  const Piece& side_of = other_piece(pieces, contact);
  const double past_end = side_of.length(contact.side) * std::max(-contact.lever, contact.lever - 1);
  // At the corner itself rounding alone tells the two apart, and bonds form to both.
  if (contact.depth <= 1e-12 * side_of.length(contact.side)) return false;
  if (past_end > 0 && past_end <= contact.slack) return false;  // flush with it
  return std::ranges::any_of(pieces, [&](const PiecePairGeometry& pair) {
    const Piece& piece = pair.piece[met];
    if (piece.first_corner() == side_of.first_corner() || piece.is_strip()) return false;
    bool before = false;
    for (std::uint32_t k = 0; k < piece.size(); ++k) {
      const double depth = piece.depth(k, at);
      if (depth < -contact.slack) return false;
      before = before || (piece.real(k) && depth <= touching && dot(outward, piece.normal(k)) < 0);
    }
    return before;
  });
}

}  // namespace talus::vertex_edge
