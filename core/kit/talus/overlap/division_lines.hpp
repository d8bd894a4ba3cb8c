#pragma once

// Lines within a body along which the pressure jumps, since the stiffness is another beyond them. What
// presses on such a line from one of its sides is borne as the line moves: minus the gradient of the energy.

#include <talus/overlap/cell_loads.hpp>

#include <cmath>
#include <cstdint>

namespace talus::overlap {

/// A side that makes a line; of none there is no piece.
struct LineSide {
  const Piece* piece = nullptr;
  std::uint32_t side = 0;
};

/// Through the vertex at which one side ends and the other starts: it moves with that, and turns as the two
/// do on average.
inline void bear_at_vertex(const LoadSink& sink, LineSide ends, LineSide starts, Point vertex,
                           const Balance& load) {
  const double share = ends.piece != nullptr && starts.piece != nullptr ? 0.5 : 1;
  const auto bear = [&](const LineSide& at, std::uint32_t corner) {
    sink.at_corner(*at.piece, corner, share * load.force);
    sink.couple(*at.piece, at.side, share * load.moment_about(vertex));
  };
  if (ends.piece != nullptr) bear(ends, ends.piece->next(ends.side));
  if (starts.piece != nullptr) bear(starts, starts.side);
}

/// Where two sides are equally near. As they move by δ₁ and δ₂ it does by (δ₁ n₁ − δ₂ n₂)/|n₁ − n₂|.
inline void bear_between(const LoadSink& sink, LineSide one, LineSide other, Point middle,
                         const Balance& load) {
  constexpr double least_turn = 0.05;  // sine, between sides that compete
  const double share = one.piece != nullptr && other.piece != nullptr ? 0.5 : 1;
  Point force[2] = {share * load.force, share * load.force};
  if (share < 1) {
    const Point first = one.piece->normal(one.side), second = other.piece->normal(other.side);
    const double turn = cross(first, second);
    if (std::abs(turn) > least_turn) {
      force[0] = (cross(load.force, second) / turn) * first;
      force[1] = (cross(first, load.force) / turn) * second;
    }
  }
  const LineSide sides[] = {one, other};
  for (int i = 0; i < 2; ++i) {
    if (sides[i].piece == nullptr) continue;
    sink.at_point(*sides[i].piece, sides[i].side, middle, force[i]);
    sink.couple(*sides[i].piece, sides[i].side, share * load.moment_about(middle));
  }
}

/// Between two sides of one piece.
inline void bear_line(const LoadSink& sink, LineSide one, LineSide other, Point middle, const Balance& load) {
  const Piece& piece = *one.piece;
  if (piece.next(one.side) == other.side)
    bear_at_vertex(sink, one, other, piece.at(other.side), load);
  else if (piece.next(other.side) == one.side)
    bear_at_vertex(sink, other, one, piece.at(one.side), load);
  else
    bear_between(sink, one, other, middle, load);
}

}  // namespace talus::overlap
