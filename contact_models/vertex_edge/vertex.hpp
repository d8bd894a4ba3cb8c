#pragma once

#include <talus/overlap/piece.hpp>

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

namespace talus::vertex_edge {

using overlap::Piece;
using overlap::Point;

struct PiecePairGeometry {
  Piece piece[2];
};

/// Cosine of the turn below which two edges count as one straight stretch.
inline constexpr double straight = 1 - 1e-9;

/// A corner of a body's boundary that points outward, as one of the pieces has it that meet there.
struct Vertex {
  Point before, after;  ///< tangents of the edges that meet in it
  double shorter;       ///< m, length of the shorter of them; of a divided one with all that is straight
  std::uint32_t name;   ///< number of a corner, the same for all pieces that have this one
  bool divided;         ///< a cut ends in it: the piece has one of the edges only
};

/// The straight stretch of boundary that a side belongs to, along its tangent from its start: collinear
/// neighbours count as one, also beyond a cut, so that passing from one to the next changes nothing.
/// `spanned`: with what an edge that lies flat on it spans of sides that turn inwards.
inline std::pair<double, double> straight_run(const Piece& own, std::uint32_t side, bool spanned = false) {
  const auto goes_on = [&](std::uint32_t other) {
    return other != side && own.real(other) && dot(own.tangent(side), own.tangent(other)) >= straight;
  };
  double low = 0, high = own.length(side);
  std::uint32_t at = side;
  for (; goes_on(own.next(at)); at = own.next(at)) high += own.length(own.next(at));
  high += own.straight_after(at) + (spanned ? own.spanned_after(at) : 0);
  for (at = side; goes_on(own.previous(at)); at = own.previous(at)) low -= own.length(own.previous(at));
  low -= own.straight_before(at) + (spanned ? own.spanned_before(at) : 0);
  return {low, high};
}

/// Finds what lies beyond the cuts of concave bodies, among the pieces of a pair.
class Vertices {
 public:
  Vertices(std::span<const PiecePairGeometry> pieces, std::uint32_t body) : pieces_(pieces), body_(body) {}

  /// Nothing where the boundary does not turn outward: at the start of a cut, at its end on a straight side,
  /// at a joint between collinear edges.
  std::optional<Vertex> at(const Piece& own, std::uint32_t v) const {
    const std::uint32_t before = own.previous(v);
    if (own.real(before) && own.real(v))
      return turning({&own, before}, {&own, v}, own.first_corner() + v, false);
    if (own.real(before) && own.is_cut(v)) {
      const auto after = follow(own, v, v, true);
      return after ? turning({&own, before}, *after, own.first_corner() + v, true) : std::nullopt;
    }
    if (own.real(v) && own.is_cut(before)) {
      const auto found = follow(own, v, before, false);
      if (!found) return std::nullopt;
      const std::uint32_t corner = found->piece->next(found->side);
      return turning(*found, {&own, v}, found->piece->first_corner() + corner, true);
    }
    return std::nullopt;
  }

 private:
  struct Edge {
    const Piece* piece;
    std::uint32_t side;

    Point tangent() const { return piece->tangent(side); }
    double length() const { return piece->length(side); }
  };

  static std::optional<Vertex> turning(Edge before, Edge after, std::uint32_t name, bool divided) {
    if (!(dot(before.tangent(), after.tangent()) < straight)) return std::nullopt;
    if (divided && !(cross(before.tangent(), after.tangent()) > 0)) return std::nullopt;
    const auto length = [&](const Edge& edge) {
      if (!divided) return edge.length();
      const auto [low, high] = straight_run(*edge.piece, edge.side);
      return high - low;
    };
    return Vertex{before.tangent(), after.tangent(), std::min(length(before), length(after)), name, divided};
  }

  /// The edge beyond the cuts that end in a corner of a piece, the first of them its side `cut`:
  /// counter-clockwise around the body, `forward`, or the other way.
  std::optional<Edge> follow(const Piece& own, std::uint32_t v, std::uint32_t cut, bool forward) const {
    Edge at{&own, cut};
    for (std::size_t crossed = 0; crossed < pieces_.size(); ++crossed) {
      const std::optional<Edge> other_bank = across(at, own.at(v), forward);
      if (!other_bank) return std::nullopt;
      const Piece& piece = *other_bank->piece;
      at.piece = &piece;
      at.side = forward ? piece.next(other_bank->side) : piece.previous(other_bank->side);
      if (!piece.is_cut(at.side)) return piece.real(at.side) ? std::optional(at) : std::nullopt;
    }
    return std::nullopt;
  }

  /// The same cut as a side of the piece beyond it, where it has the corner at a point as its end (`forward`)
  /// or as its start.
  std::optional<Edge> across(Edge cut, Point corner, bool forward) const {
    const double near = 1e-9 * cut.length();
    for (const PiecePairGeometry& pair : pieces_) {
      const Piece& piece = pair.piece[body_];
      if (piece.first_corner() == cut.piece->first_corner()) continue;
      for (std::uint32_t side = 0; side < piece.size(); ++side) {
        if (!piece.is_cut(side) || piece.cut(side) != cut.piece->cut(cut.side)) continue;
        const Point apart = piece.at(forward ? piece.next(side) : side) - corner;
        if (dot(apart, apart) <= near * near) return Edge{&piece, side};
      }
    }
    return std::nullopt;
  }

  std::span<const PiecePairGeometry> pieces_;
  std::uint32_t body_;
};

}  // namespace talus::vertex_edge
