#pragma once

// The edges that meet in a vertex, and the length of boundary whose load it carries.

#include "corner_contact.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace talus::vertex_edge {

/// Whether an edge is no more than a corner cut off, or rounding, between two others. The end of a thin plate
/// is none: its neighbours run back beside each other.
inline bool is_short(const Piece& piece, std::uint32_t edge) {
  constexpr double share = 1e-3, runs_back = -0.98;
  const std::uint32_t before = piece.previous(edge), after = piece.next(edge);
  const auto turns = [&](std::uint32_t other) {
    return dot(piece.tangent(other), piece.tangent(edge)) < straight;
  };
  return piece.length(edge) < share * std::max(piece.length(before), piece.length(after)) && turns(before) &&
         turns(after) && dot(piece.tangent(before), piece.tangent(after)) > runs_back;
}

/// Of the edges that meet in a vertex, the one that lies flatter on a side along `along`; a short one only
/// beside another. Where a cut ends in the vertex, the one that the piece has.
inline std::uint32_t flatter_edge(const Piece& own, std::uint32_t v, Point along) {
  if (own.is_strip()) return 0;
  const std::uint32_t before = own.previous(v);
  if (own.is_cut(before) != own.is_cut(v)) return own.is_cut(v) ? before : v;
  if (is_short(own, before) != is_short(own, v)) return is_short(own, v) ? before : v;
  return dot(own.tangent(before), along) < dot(own.tangent(v), along) ? before : v;
}

/// m, of the edges that meet in a vertex, each with what lies straight beyond it; short ones left out.
inline double shorter_edge(const Piece& own, std::uint32_t v) {
  if (own.is_strip()) return own.length(0);
  std::uint32_t before = own.previous(v), after = v;
  // Mostly the shorter one ends where it is.
  const bool first = own.length(before) < own.length(after);
  const std::uint32_t shorter = first ? before : after,
                      beyond = first ? own.previous(before) : own.next(after);
  if (!is_short(own, shorter) && !own.is_cut(beyond) &&
      !(dot(own.tangent(shorter), own.tangent(beyond)) >= straight))
    return own.length(shorter);
  if (is_short(own, before)) before = own.previous(before);
  if (is_short(own, after)) after = own.next(after);
  const auto length = [&](std::uint32_t edge) {
    const auto [low, high] = straight_run(own, edge);
    return high - low;
  };
  return std::min(length(before), length(after));
}

/// A twentieth of the shorter edge: for a corner that meets a corner, or comes alone.
inline double least_tributary(double own, double other) {
  return 0.05 * std::min(own, other);
}
/// By how much the tributary of a vertex that lies flat on a side grows with its depth, m per m, as far as
/// `least_tributary`. Deep corners bear as those that lean do; one that slides over a joint hits the flank
/// behind that softly.
inline constexpr double grows = 20;

/// Half of the stretch over which the vertex's flatter edge faces the other body, so that the two corners
/// of a flat contact carry α_N L together. Notes what the spring of one that grows with its depth holds.
inline double tributary_length(std::span<const PiecePairGeometry> pieces, CornerContact& contact) {
  const std::uint32_t body = contact.vertex_body, side = contact.side;
  const Piece &own = pieces[contact.entry].piece[body], &other = pieces[contact.entry].piece[1 - body];
  const Point along = other.tangent(side);
  if (own.is_strip() && other.is_strip()) return own.length(0) / 2 * std::abs(dot(own.tangent(0), along));
  const std::uint32_t edge = flatter_edge(own, contact.vertex, along);
  const auto [own_low, own_high] = straight_run(own, edge, !other.is_strip());
  const double start = dot(along, own.at(edge) + own_low * own.tangent(edge) - other.at(side));
  const double end = dot(along, own.at(edge) + own_high * own.tangent(edge) - other.at(side));
  const auto [low, high] = straight_run(other, side, true);
  const double shadow = std::min(high, std::max(start, end)) - std::max(low, std::min(start, end));
  // A side that stands upright on the other, at the end of a base, carries nothing there.
  if (own.is_strip()) return std::max(shadow, 0.0) / 2;
  // An edge that lies flat on the side bears what faces it: past the end of the side, or over a joint to
  // the next, that is next to nothing. One that leans bears the least at any depth.
  const double least = least_tributary(own_high - own_low, high - low),
               leans = std::abs(dot(own.tangent(edge), other.normal(side))) / leaning;
  const double faces = std::max(shadow / 2, least * std::min(leans, 1.0));
  if (!(contact.depth > 0 && grows * contact.depth > faces && faces < least)) return faces;
  // With a length t that grows so its spring holds ∫ t d, not t d²/2.
  const double d = contact.depth, from = faces / grows, to = std::min(d, least / grows);
  const double held = faces * from * from / 2 + grows * (to * to * to - from * from * from) / 3 +
                      least * (d * d - to * to) / 2;
  const double length = grows * to;
  contact.filled = held / (length * d * d / 2);
  return length;
}

}  // namespace talus::vertex_edge
