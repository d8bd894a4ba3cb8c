#pragma once

#include <talus/contact_model.hpp>
#include <talus/simd/pack.hpp>

#include <bit>
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

/// A pair of plain bodies in each lane.
struct LanePairs {
  const BodyPair* at[lanes];

  /// Eight bytes of each, from `offset` bytes after its beginning.
  Numbers read(std::size_t offset) const {
    Numbers all;
    for (int lane = 0; lane < lanes; ++lane) {
      std::uint64_t number;
      std::memcpy(&number, reinterpret_cast<const char*>(at[lane]) + offset, sizeof number);
      all[lane] = number;
    }
    return all;
  }

  /// Bytes from Boundaries::corner to the first corner of body a and of body b.
  struct FirstCorners {
    Numbers a, b;
  };
  FirstCorners first_corners() const {
    const Numbers both = read(offsetof(BodyPair, corner_start));
    return {(both & 0xFFFFFFFF) * sizeof(BoundaryCorner), (both >> 32) * sizeof(BoundaryCorner)};
  }

  /// How many corners body a and body b have.
  struct CornerCounts {
    Numbers a, b;
  };
  CornerCounts corner_counts() const {
    const Numbers both = read(offsetof(BodyPair, contact_count)) >> 32;
    return {both & 0xFFFF, both >> 16};
  }
  Numbers contact_count() const { return read(offsetof(BodyPair, contact_count)) & 0xFFFFFFFF; }
};
static_assert(std::endian::native == std::endian::little, "the low half of a number comes first");
static_assert(offsetof(BodyPair, plain_corners) == offsetof(BodyPair, contact_count) + 4);

/// In place of a number of sides that all lanes have.
inline constexpr int mixed = 0;
/// How many corners the lanes have, at most `corners` where they are mixed.
constexpr int corners_of(int sides, int corners) {
  return sides == mixed ? corners : sides;
}

/// One piece in each lane, as the host's arrays know it. Where lanes are mixed, a piece with fewer corners
/// than the widest begins again after its last: sides that own nothing.
struct LanePieces {
  const BoundaryCorner* corner;  ///< Boundaries::corner
  Numbers first;                 ///< bytes from there to its first corner
  Numbers start;                 ///< bytes from its first corner to the one called 0 here
  Numbers count;                 ///< of corners
  Packs2 offset;                 ///< m, added to all places

  /// Which corner is called 0 here.
  Numbers start_corner() const { return start / sizeof(BoundaryCorner); }

  /// The number of sides, if all lanes have 3 or all have 4.
  int sides() const {
    const std::uint64_t any = count[0];
    return any > 4 || simd::any(simd::nonzero(count ^ any)) ? mixed : static_cast<int>(any);
  }

  /// Calls visit(i, bytes of each lane) for `corners` corners in turn.
  template <int corners, int sides, class Visit>
  void each_corner(const Visit& visit) const {
    constexpr std::uint64_t step = sizeof(BoundaryCorner);
    const Numbers end = sides == mixed ? count * step : Numbers{} + sides * step;
    Numbers turn = start;
    for (int i = 0; i < corners; ++i) {
      const Numbers bytes = first + turn;
      visit(i, bytes);
      turn += step;
      turn = turn == end ? Numbers{} : turn;
    }
  }

  /// Place and tangent of a corner, then, if `whole`, velocity and length.
  template <bool whole>
  void read_rows(const Numbers& bytes, Pack* to) const {
    const double* row[lanes];
    for (int lane = 0; lane < lanes; ++lane)
      row[lane] = reinterpret_cast<const double*>(reinterpret_cast<const char*>(corner) + bytes[lane]);
    simd::gather_rows(row, to);
    if constexpr (whole) simd::gather_rows(row, to + 4, 4);
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

  /// Everything; no loads act.
  template <int sides>
  void read(const LanePieces& pieces) {
    constexpr int last = corners_of(sides, corners);
    read_each<sides, true>(pieces);
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

  /// Where the corners are and how the sides run, no more.
  template <int sides>
  void read_shape(const LanePieces& pieces) {
    read_each<sides, false>(pieces);
  }

 private:
  template <int sides, bool whole>
  void read_each(const LanePieces& pieces) {
    pieces.each_corner<corners_of(sides, corners), sides>([&](int i, const Numbers& bytes) {
      Pack row[8];
      pieces.read_rows<whole>(bytes, row);
      corner[i].at = Packs2{row[0], row[1]} + pieces.offset;
      corner[i].tangent = {row[2], row[3]};
      if constexpr (whole) {
        corner[i].velocity = {row[4], row[5]};
        corner[i].length = row[6];
        corner[i].load = {0.0, 0.0};
      }
      if constexpr (sides == mixed) {
        const Numbers here = Numbers{} + static_cast<std::uint64_t>(i);
        real[i] = simd::bits(simd::nonzero(here < pieces.count ? ~Numbers{} : Numbers{}));
      }
    });
  }
};

}  // namespace TALUS_SIMD_LEVEL
}  // namespace talus::overlap
