#pragma once

#include <talus/contact_model.hpp>
#include <talus/simd/pack.hpp>

#include <algorithm>

namespace talus::overlap {
inline namespace TALUS_SIMD_LEVEL {

using simd::lanes;
using simd::Mask;
using simd::Pack;
using simd::Packs2;

/// One piece in each lane, as the host's arrays know it. A piece with fewer corners than the widest begins
/// again after its last: sides that own nothing.
struct LanePieces {
  const BoundaryCorner* first[lanes];
  std::uint32_t corners_in[lanes];
  std::uint32_t start_in[lanes];  ///< corner that is called 0 here
  alignas(64) double offset_x[lanes], offset_y[lanes], clear_depth[lanes];

  void set(int lane, const Boundaries& boundaries, std::uint32_t piece, double x, double y,
           std::uint32_t start) {
    const std::uint32_t begin = boundaries.piece_start[piece];
    first[lane] = boundaries.corner + begin;
    corners_in[lane] = boundaries.piece_start[piece + 1] - begin;
    start_in[lane] = start;
    offset_x[lane] = x;
    offset_y[lane] = y;
    clear_depth[lane] = boundaries.clear_depth[piece];
  }

  bool all_have(std::uint32_t corners) const {
    std::uint32_t other = 0;
    for (const std::uint32_t count : corners_in) other |= count ^ corners;
    return other == 0;
  }

  /// Corner i of each lane, after those before it; `full`: all have `corners`, a power of two.
  template <int corners, bool full>
  void find(int i, const BoundaryCorner** corner) const {
    for (int lane = 0; lane < lanes; ++lane) {
      if constexpr (full) {
        corner[lane] = first[lane] + ((start_in[lane] + i) & (corners - 1));
      } else if (i == 0) {
        corner[lane] = first[lane] + start_in[lane];
      } else {
        const BoundaryCorner* next = corner[lane] + 1;
        corner[lane] = next == first[lane] + corners_in[lane] ? first[lane] : next;
      }
    }
  }
};

/// The first four members of a corner (place and tangent), or the next four (velocity, length).
inline void read_rows(const BoundaryCorner* const* corner, bool second_half, Pack* to) {
  const double* row[lanes];
  for (int lane = 0; lane < lanes; ++lane) row[lane] = second_half ? &corner[lane]->vx : &corner[lane]->x;
  simd::gather_rows(row, to);
}

/// Where the corners of a piece are and how its sides run, `corners` at most; entry `corners` repeats entry
/// 0.
template <int corners>
struct LaneShape {
  Packs2 at[corners + 1], tangent[corners + 1];
  unsigned real[corners];  ///< lanes that have this side, as bits; not told where all have all

  template <bool full>
  void read(const LanePieces& pieces) {
    read<full>(pieces, [](int, const BoundaryCorner* const*) {});
  }

  /// Hands each corner of the lanes to more(i, corner), too.
  template <bool full, class More>
  void read(const LanePieces& pieces, const More& more) {
    const Packs2 offset{simd::load(pieces.offset_x), simd::load(pieces.offset_y)};
    const BoundaryCorner* corner[lanes];
    for (int i = 0; i < corners; ++i) {
      pieces.find<corners, full>(i, corner);
      Pack row[4];
      read_rows(corner, false, row);
      at[i] = Packs2{row[0], row[1]} + offset;
      tangent[i] = {row[2], row[3]};
      more(i, corner);
      if constexpr (!full) {
        real[i] = 0;
        for (int lane = 0; lane < lanes; ++lane)
          real[i] |= (static_cast<std::uint32_t>(i) < pieces.corners_in[lane] ? 1u : 0u) << lane;
      }
    }
    at[corners] = at[0];
    tangent[corners] = tangent[0];
  }

  Pack depth(int side, Packs2 point) const { return simd::cross(tangent[side], point - at[side]); }
};

/// A piece with all that contact reads of it.
template <int corners>
struct LanePiece : LaneShape<corners> {
  Packs2 velocity[corners + 1];
  Pack length[corners], inverse_length[corners];
  Packs2 last_tangent;  ///< of the side that ends at corner 0
  Pack clear_depth;
  Mask degenerate;  ///< has a side without length

  template <bool full>
  void read(const LanePieces& pieces) {
    degenerate = simd::nowhere();
    LaneShape<corners>::template read<full>(pieces, [&](int i, const BoundaryCorner* const* corner) {
      Pack row[4];
      read_rows(corner, true, row);
      velocity[i] = {row[0], row[1]};
      length[i] = row[2];
      inverse_length[i] = 1.0 / length[i];
      degenerate = degenerate | (length[i] <= 0.0);
    });
    velocity[corners] = velocity[0];
    if constexpr (full) {
      last_tangent = this->tangent[corners - 1];
    } else {
      last_tangent = this->tangent[2];  // no piece has fewer corners
      for (int i = 3; i < corners; ++i)
        last_tangent = simd::select(simd::mask_of(this->real[i]), this->tangent[i], last_tangent);
    }
    clear_depth = simd::load(pieces.clear_depth);
  }

  Packs2 normal(int side) const { return {this->tangent[side].y, -this->tangent[side].x}; }  ///< outward
};

}  // namespace TALUS_SIMD_LEVEL
}  // namespace talus::overlap
