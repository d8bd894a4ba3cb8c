#pragma once

#include <talus/contact_model.hpp>
#include <talus/simd/pack.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace talus::overlap {
inline namespace TALUS_SIMD_LEVEL {

using simd::lanes;
using simd::Mask;
using simd::Numbers;
using simd::Pack;
using simd::Packs2;

/// In place of a number of sides that all lanes have.
inline constexpr int mixed = 0;
/// How many corners the lanes have, at most `corners` where they are mixed.
constexpr int corners_of(int sides, int corners) {
  return sides == mixed ? corners : sides;
}

/// 3 or 4 if all lanes have so many corners [lane], else mixed.
template <class Count>
inline int sides_of(const Count& count) {
  std::uint32_t other = 0;
  for (int lane = 1; lane < lanes; ++lane) other |= count[lane] ^ count[0];
  return other != 0 || count[0] > 4 ? mixed : static_cast<int>(count[0]);
}

/// Where a piece is in the host's array, a piece in each lane.
struct LanePlaces {
  Numbers first;       ///< corner of all that is corner 0 of the piece
  Numbers load_shift;  ///< from its corners to their loads
  Numbers start;       ///< the corner of the piece that is called 0 here
  Numbers count;       ///< of corners

  void place(int lane, std::uint32_t first_corner, std::uint32_t corner_count) {
    first[lane] = first_corner;
    count[lane] = corner_count;
  }
};

/// Where the corners of the pieces are. Where lanes are mixed, a piece with fewer corners than the widest
/// begins again after its last: sides that own nothing.
template <int corners>
struct LaneRows {
  Numbers row[corners];         ///< doubles from Boundaries::corner on
  Numbers load[corners];        ///< doubles from ContactLoads::corner on, of lanes that are not mixed
  std::uint32_t real[corners];  ///< of mixed lanes: which have this side, as bits

  template <int sides>
  void lay_out(const LanePlaces& at) {
    constexpr std::uint32_t doubles = sizeof(BoundaryCorner) / sizeof(double),
                            doubles_of_load = sizeof(CornerLoad) / sizeof(double);
    Numbers turn = at.start;
    for (int i = 0; i < corners_of(sides, corners); ++i) {
      row[i] = (at.first + turn) * doubles;
      load[i] = (at.first + turn + at.load_shift) * doubles_of_load;
      turn += 1;
      turn = turn == at.count ? Numbers{} : turn;
    }
    if constexpr (sides == mixed) {
      for (int i = 0; i < corners; ++i) {
        real[i] = 0;
        for (int lane = 0; lane < lanes; ++lane)
          real[i] |= (static_cast<std::uint32_t>(i) < at.count[lane] ? 1U : 0U) << lane;
      }
    }
  }

  /// Place and tangent of corner i, then, if `whole`, velocity and length.
  template <bool whole>
  void read(const BoundaryCorner* corner, int i, Pack* to) const {
    const double* from[lanes];
    for (int lane = 0; lane < lanes; ++lane)
      from[lane] = reinterpret_cast<const double*>(corner) + row[i][lane];
    simd::gather_rows(from, to);
    if constexpr (whole) simd::gather_rows(from, to + 4, 4);
  }
};
static_assert(offsetof(BoundaryCorner, vx) == 4 * sizeof(double));

/// A corner in each lane, the side that starts there, and what acts at the corner. The next of a piece lies
/// behind it.
struct LaneCorner {
  Packs2 at, tangent, velocity;
  Pack length;
  Packs2 load;  ///< N/m

  Packs2 normal() const { return {tangent.y, -tangent.x}; }  ///< outward
  Pack depth(Packs2 point) const { return simd::cross(tangent, point - at); }
  void push(Pack size, Packs2 direction) { load = load + size * direction; }
};

/// A piece with all that contact reads of it, `corners` at most. The entry after the last repeats where entry
/// 0 is and how it moves; what was pushed there is added to entry 0 in the end.
template <int corners>
struct LanePiece {
  LaneCorner corner[corners + 1];
  unsigned real[corners];  ///< of mixed lanes: which have this side, as bits
  Packs2 last_tangent;     ///< of the side that ends at corner 0
  Mask degenerate;         ///< has a side without length

  /// Everything; no loads act. `offset`, m, is added to all places.
  template <int sides>
  void read(const BoundaryCorner* from, const LaneRows<corners>& rows, Packs2 offset) {
    constexpr int last = corners_of(sides, corners);
    read_each<sides, true>(from, rows, offset);
    Pack shortest = corner[0].length;
    for (int i = 1; i < last; ++i) shortest = simd::min(shortest, corner[i].length);
    degenerate = shortest <= 0.0;
    corner[last].at = corner[0].at;
    corner[last].velocity = corner[0].velocity;
    corner[last].load = {0.0, 0.0};
    if constexpr (sides != mixed) {
      last_tangent = corner[last - 1].tangent;
    } else {
      last_tangent = corner[2].tangent;  // no piece has fewer corners
      for (int i = 3; i < corners; ++i)
        last_tangent = simd::select(simd::mask_of(real[i]), corner[i].tangent, last_tangent);
    }
  }

  /// The largest triangle of the fan from corner 0. What is affine over the piece, as the motion of plain
  /// bodies is, follows from its corners.
  struct Triangle {
    Packs2 first, second;  ///< m, from corner 0 to corners `number` and `number` + 1
    Pack number;
    Pack inverse;  ///< 1/m², of their cross product
  };
  template <int sides>
  Triangle largest_triangle() const {
    constexpr int count = corners_of(sides, corners);
    Packs2 first = corner[1].at - corner[0].at, edge[2] = {first, corner[2].at - corner[0].at};
    Packs2 second = edge[1];
    Pack largest = simd::cross(first, second), number = 1.0;
    for (int i = 2; i + 1 < count; ++i) {
      edge[0] = edge[1];
      edge[1] = corner[i + 1].at - corner[0].at;
      const Pack area = simd::cross(edge[0], edge[1]);
      const Mask larger = area > largest;
      largest = simd::select(larger, area, largest);
      first = simd::select(larger, edge[0], first);
      second = simd::select(larger, edge[1], second);
      number = simd::select(larger, static_cast<double>(i), number);
    }
    return {first, second, number, 1.0 / largest};
  }

  /// How it moves: the velocity of corner 0, m/s, and how it changes along x and y, 1/s.
  struct Motion {
    Packs2 start, by_x, by_y;
  };
  template <int sides>
  Motion motion(const Triangle& of) const {
    Packs2 first = corner[1].velocity, second = corner[2].velocity;
    for (int i = 2; i + 1 < corners_of(sides, corners); ++i) {
      const Mask here = of.number == static_cast<double>(i);
      first = simd::select(here, corner[i].velocity, first);
      second = simd::select(here, corner[i + 1].velocity, second);
    }
    first = of.inverse * (first - corner[0].velocity);
    second = of.inverse * (second - corner[0].velocity);
    return {corner[0].velocity, of.second.y * first - of.first.y * second,
            of.first.x * second - of.second.x * first};
  }

  /// Loads the corners by forces at some points: their sum, N/m, and those of either component times where
  /// they act, N.
  template <int sides>
  void push_at_points(const Triangle& of, Packs2 force, Packs2 moment_x, Packs2 moment_y) {
    Pack x[corners], y[corners];
    share_out<sides>(of, force.x, moment_x, x);
    share_out<sides>(of, force.y, moment_y, y);
    for (int i = 0; i < corners_of(sides, corners); ++i) corner[i].load = corner[i].load + Packs2{x[i], y[i]};
  }

  /// Of mixed lanes: load that came to the repeated first corner of a piece with fewer corners, of which it
  /// has `count`, goes to that corner. What is left is what the same piece has among its like.
  void fold_repeated(const Numbers& count) {
    const Pack own = simd::doubles(count);
    for (int i = 3; i < corners; ++i) {
      const Mask repeated = own <= static_cast<double>(i);
      const auto fold = [&](Pack& to, Pack& from) {
        to = simd::select(repeated, to + from, to);
        from = simd::select(repeated, 0.0, from);
      };
      fold(corner[0].load.x, corner[i].load.x);
      fold(corner[0].load.y, corner[i].load.y);
    }
  }

  /// Where the corners are and how the sides run, no more.
  template <int sides>
  void read_shape(const BoundaryCorner* from, const LaneRows<corners>& rows, Packs2 offset) {
    read_each<sides, false>(from, rows, offset);
  }

 private:
  /// [corner] what corners have of weights at some points, of which `moment` is the sum times where they are.
  template <int sides>
  void share_out(const Triangle& of, Pack weight, Packs2 moment, Pack* share) const {
    constexpr int count = corners_of(sides, corners);
    const Packs2 from = moment - weight * corner[0].at;
    const Pack first = simd::cross(from, of.second) * of.inverse,
               second = simd::cross(of.first, from) * of.inverse;
    share[0] = weight - first - second;
    if constexpr (count == 3) {
      share[1] = first;
      share[2] = second;
    } else {
      share[1] = simd::only_where(of.number == 1.0, first);
      for (int i = 2; i < count; ++i)
        share[i] = simd::select(of.number == static_cast<double>(i), first,
                                simd::only_where(of.number == static_cast<double>(i - 1), second));
    }
  }

  template <int sides, bool whole>
  void read_each(const BoundaryCorner* from, const LaneRows<corners>& rows, Packs2 offset) {
    if constexpr (sides == mixed) std::memcpy(real, rows.real, sizeof real);
    for (int i = 0; i < corners_of(sides, corners); ++i) {
      Pack row[8];
      rows.template read<whole>(from, i, row);
      corner[i].at = Packs2{row[0], row[1]} + offset;
      corner[i].tangent = {row[2], row[3]};
      if constexpr (whole) {
        corner[i].velocity = {row[4], row[5]};
        corner[i].length = row[6];
        corner[i].load = {0.0, 0.0};
      }
    }
  }
};

}  // namespace TALUS_SIMD_LEVEL
}  // namespace talus::overlap
