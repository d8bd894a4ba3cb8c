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
  const BoundaryCorner *first[lanes], *end[lanes];
  const BoundaryCorner* start[lanes];  ///< corner that is called 0 here
  alignas(64) double offset_x[lanes], offset_y[lanes], clear_depth[lanes], size[lanes];

  void set(int lane, const Boundaries& boundaries, std::uint32_t piece, double x, double y,
           std::uint32_t from) {
    first[lane] = boundaries.corner + boundaries.piece_start[piece];
    end[lane] = boundaries.corner + boundaries.piece_start[piece + 1];
    start[lane] = first[lane] + from;
    offset_x[lane] = x;
    offset_y[lane] = y;
    clear_depth[lane] = boundaries.clear_depth[piece];
    size[lane] = static_cast<double>(end[lane] - first[lane]);
  }

  int corners_in(int lane) const { return static_cast<int>(end[lane] - first[lane]); }
  int start_in(int lane) const { return static_cast<int>(start[lane] - first[lane]); }

  /// From each corner to the next.
  void advance(const BoundaryCorner** corner) const {
    for (int lane = 0; lane < lanes; ++lane) {
      const BoundaryCorner* next = corner[lane] + 1;
      corner[lane] = next == end[lane] ? first[lane] : next;
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
  unsigned real[corners];  ///< lanes that have this side, as bits

  void read(const LanePieces& pieces) {
    read(pieces, [](int, const BoundaryCorner* const*) {});
  }

  /// Hands each corner of the lanes to more(i, corner), too.
  template <class More>
  void read(const LanePieces& pieces, const More& more) {
    const Packs2 offset{simd::load(pieces.offset_x), simd::load(pieces.offset_y)};
    const Pack size = simd::load(pieces.size);
    const BoundaryCorner* corner[lanes];
    std::copy(pieces.start, pieces.start + lanes, corner);
    for (int i = 0; i < corners; ++i) {
      Pack row[4];
      read_rows(corner, false, row);
      at[i] = Packs2{row[0], row[1]} + offset;
      tangent[i] = {row[2], row[3]};
      real[i] = simd::bits(Pack(static_cast<double>(i)) < size);
      more(i, corner);
      pieces.advance(corner);
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
    degenerate = simd::nowhere();
    LaneShape<corners>::read(pieces, [&](int i, const BoundaryCorner* const* corner) {
      Pack row[4];
      read_rows(corner, true, row);
      velocity[i] = {row[0], row[1]};
      length[i] = row[2];
      inverse_length[i] = 1.0 / length[i];
      degenerate = degenerate | (length[i] <= 0.0);
    });
    velocity[corners] = velocity[0];
    last_tangent = this->tangent[2];  // no piece has fewer corners
    for (int i = 3; i < corners; ++i)
      last_tangent = simd::select(simd::mask_of(this->real[i]), this->tangent[i], last_tangent);
    clear_depth = simd::load(pieces.clear_depth);
  }

  Packs2 normal(int side) const { return {this->tangent[side].y, -this->tangent[side].x}; }  ///< outward
};

}  // namespace TALUS_SIMD_LEVEL
}  // namespace talus::overlap
