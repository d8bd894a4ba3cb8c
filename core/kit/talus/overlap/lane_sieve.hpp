#pragma once

#include <talus/contact_model.hpp>
#include <talus/overlap/lane_piece.hpp>

namespace talus::overlap {
inline namespace TALUS_SIMD_LEVEL {

/// Looks at pairs of plain bodies, one in each lane, for a side that has the other piece outside. Without one
/// they overlap.
template <int corners>
class LaneSieve {
 public:
  alignas(64) double gap[lanes];  ///< m, by which the pieces are apart at least; negative: they overlap

  /// `numbers` of pairs in the batch; lanes from `count` on repeat the first.
  void look(const ContactBatch& batch, const std::uint32_t* numbers, int count) {
    LanePlaces at[2]{};
    const double* place[lanes];
    for (int lane = 0; lane < lanes; ++lane) {
      const BodyPair& pair = batch.pairs[numbers[lane < count ? lane : 0]];
      for (int body = 0; body < 2; ++body)
        at[body].place(lane, pair.corner_start[body], pair.plain_corners[body]);
      place[lane] = &pair.offset_x;
    }
    const BoundaryCorner* const corner = batch.boundaries.corner;
    const Packs2 offset = simd::gather_points(place);
    simd::store(-least_reach_of_both(corner, at, offset), gap);
  }

  /// The corner before the side of a body that faces the other.
  std::uint32_t start(const BodyPair& pair, int body, int lane) const {
    const auto side = static_cast<std::uint32_t>(facing_[body][lane]);
    return (side == 0 ? pair.plain_corners[body] : side) - 1;
  }

 private:
  Pack least_reach_of_both(const BoundaryCorner* corner, const LanePlaces* at, Packs2 offset) {
    if constexpr (corners == 4) {
      if (sides_of(at[0].count) == 4 && sides_of(at[1].count) == 4)
        return least_reach_of_all<4>(corner, at, offset);
    }
    return least_reach_of_all<mixed>(corner, at, offset);
  }

  template <int sides>
  Pack least_reach_of_all(const BoundaryCorner* corner, const LanePlaces* at, Packs2 offset) {
    LaneRows<corners> rows[2];
    for (int p = 0; p < 2; ++p) rows[p].template lay_out<sides>(at[p]);
    piece_[0].template read_shape<sides>(corner, rows[0], {0.0, 0.0});
    piece_[1].template read_shape<sides>(corner, rows[1], offset);
    return simd::min(least_reach<sides>(0), least_reach<sides>(1));
  }

  /// How far the other piece reaches behind the side that it reaches least behind, the one facing it.
  template <int sides>
  Pack least_reach(int p) {
    const LanePiece<corners>&piece = piece_[p], &other = piece_[1 - p];
    Pack least = 1e300, side = 0.0;
    for (int k = 0; k < corners; ++k) {
      const LaneCorner& at = piece.corner[k];
      Pack deepest = at.depth(other.corner[0].at);
      for (int j = 1; j < corners; ++j) deepest = simd::max(deepest, at.depth(other.corner[j].at));
      Mask less = deepest < least;
      if constexpr (sides == mixed) less = less & simd::mask_of(piece.real[k]);
      least = simd::select(less, deepest, least);
      side = simd::select(less, static_cast<double>(k), side);
    }
    simd::store(side, facing_[p]);
    return least;
  }

  LanePiece<corners> piece_[2];
  alignas(64) double facing_[2][lanes];  ///< [body] the side
};

}  // namespace TALUS_SIMD_LEVEL
}  // namespace talus::overlap
