#pragma once

#include <talus/contact_model.hpp>
#include <talus/simd/pack.hpp>

namespace talus::overlap {
inline namespace TALUS_SIMD_LEVEL {

using simd::lanes;
using simd::Mask;
using simd::Pack;
using simd::Packs2;

/// One piece in each lane, as the host's arrays know it. A piece with fewer corners than the widest repeats
/// its first: sides without length that own nothing.
struct LanePieces {
  const BoundaryCorner* first[lanes];
  std::int32_t size[lanes];
  std::int32_t start[lanes];  ///< corner that is called 0 here
  alignas(64) double offset_x[lanes], offset_y[lanes], clear_depth[lanes];

  void set(int lane, const Boundaries& boundaries, std::uint32_t piece, double x, double y) {
    const std::uint32_t begin = boundaries.piece_start[piece];
    first[lane] = boundaries.corner + begin;
    size[lane] = static_cast<std::int32_t>(boundaries.piece_start[piece + 1] - begin);
    start[lane] = 0;
    offset_x[lane] = x;
    offset_y[lane] = y;
    clear_depth[lane] = boundaries.clear_depth[piece];
  }

  /// Corner i of each lane.
  void corner(std::int32_t i, const BoundaryCorner** result) const {
    for (int lane = 0; lane < lanes; ++lane) {
      const std::int32_t at = start[lane] + (i < size[lane] ? i : 0);
      result[lane] = first[lane] + (at >= size[lane] ? at - size[lane] : at);
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
  Mask real[corners];

  void read(const LanePieces& pieces) {
    const Packs2 offset{simd::load(pieces.offset_x), simd::load(pieces.offset_y)};
    alignas(64) double size[lanes];
    for (int lane = 0; lane < lanes; ++lane) size[lane] = pieces.size[lane];
    for (int i = 0; i < corners; ++i) {
      const BoundaryCorner* corner[lanes];
      pieces.corner(i, corner);
      Pack row[4];
      read_rows(corner, false, row);
      at[i] = Packs2{row[0], row[1]} + offset;
      tangent[i] = {row[2], row[3]};
      real[i] = Pack(static_cast<double>(i)) < simd::load(size);
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

  void read(const LanePieces& pieces) {
    LaneShape<corners>::read(pieces);
    degenerate = simd::nowhere();
    const BoundaryCorner* corner[lanes];
    Pack row[4];
    for (int i = 0; i < corners; ++i) {
      pieces.corner(i, corner);
      read_rows(corner, true, row);
      velocity[i] = {row[0], row[1]};
      length[i] = row[2];
      inverse_length[i] = 1.0 / length[i];
      degenerate = degenerate | (length[i] <= 0.0);
    }
    velocity[corners] = velocity[0];
    for (int lane = 0; lane < lanes; ++lane) {
      const std::int32_t start = pieces.start[lane];
      corner[lane] = pieces.first[lane] + (start == 0 ? pieces.size[lane] : start) - 1;
    }
    read_rows(corner, false, row);
    last_tangent = {row[2], row[3]};
    clear_depth = simd::load(pieces.clear_depth);
  }

  Packs2 normal(int side) const { return {this->tangent[side].y, -this->tangent[side].x}; }  ///< outward
};

}  // namespace TALUS_SIMD_LEVEL
}  // namespace talus::overlap
