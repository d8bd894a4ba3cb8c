#pragma once

#include <talus/overlap/lane_piece.hpp>

#include <bit>
#include <cstdint>

namespace talus::overlap {
inline namespace TALUS_SIMD_LEVEL {

/// A stretch of one slave side in the cell of one master side (Fig. 5).
struct LaneSegment {
  int master_side, slave_side;
  Mask valid;
  Pack start, end;              ///< along the slave side, 0 to 1
  Pack start_lever, end_lever;  ///< along the master side, 0 to 1
  Pack start_load, end_load;    ///< N/m, trapezoid load as two end loads
  Pack length, share;           ///< m; m², its part of the area below it
};

/// The cell of one master side.
struct LaneCell {
  int side;
  Pack load;   ///< N/m, normal
  Pack lever;  ///< where on the side, 0 to 1
  Pack share;  ///< m², sum over its segments
};

/// Cells of one piece as master, the other as slave (§3.2.1), in closed form by Green's theorem. With s along
/// a master side and d the depth behind it, a cell is bounded by stretches of slave sides, by the side itself
/// (d = 0) and by lines of division through the side's ends, along which ∮ d ds = s d/2, ∮ s d ds = s² d/3
/// and ∮ d²/2 ds = s d²/6 from the end on. So only the stretches and where they meet those lines are needed.
///
/// This holds as far down as only neighbouring sides compete, `clear_depth`. Lanes where the slave crosses
/// that level are marked `deep` and belong to the general path.
template <int corners>
class LaneCells {
 public:
  LaneCell cell[corners];
  int cell_count;
  LaneSegment segment[corners * corners];  ///< cell after cell
  int segment_start[corners + 1];          ///< [cell]
  Mask deep;
  Pack stored, penetration;       ///< J/m, m
  Pack area, moment_x, moment_y;  ///< m², m³: of the overlap, first moments
  Packs2 arc;                     ///< m, sum of the segments along the slave
  Packs2 force;                   ///< N/m on the slave

  /// `full`: all lanes have all `corners`.
  template <bool full>
  void find(const LanePiece<corners>& master, const LanePiece<corners>& slave, Pack stiffness) {
    deep = simd::nowhere();
    stored = penetration = area = moment_x = moment_y = 0.0;
    arc = force = {0.0, 0.0};
    cell_count = segment_count_ = 0;
    measure(master, slave);
#pragma GCC unroll 4
    for (int k = 0; k < corners; ++k) {
      CornerBits meetings = possible_meetings(k);
      if constexpr (!full) meetings &= each_corner(master.real[k]) & in_turn(slave.real);
      if (meetings == 0) continue;
      Integrals sum{0.0, 0.0, 0.0};
      segment_start[cell_count] = segment_count_;
      cell[cell_count].side = k;
      cell[cell_count].share = 0.0;
      while (meetings != 0) {
        const int j = std::countr_zero(meetings) / lanes;
        const CornerBits here = meetings & (all_lanes << j * lanes);
        meetings ^= here;
        cut_out(master, slave, k, j, simd::mask_of(static_cast<unsigned>(here >> j * lanes)), stiffness, sum);
      }
      if (segment_count_ > segment_start[cell_count]) close_cell(master, stiffness, sum);
    }
    segment_start[cell_count] = segment_count_;
  }

 private:
  /// What holds of corners of the slave or of the sides that start there: bit j · lanes + lane.
  using CornerBits = std::uint64_t;
  static constexpr CornerBits all_lanes = (1u << lanes) - 1;
  static constexpr int width = corners * lanes;

  static CornerBits each_corner(unsigned bits) {
    CornerBits all = bits;
    for (int shift = lanes; shift < width; shift *= 2) all |= all << shift;
    return all;
  }
  static CornerBits in_turn(const unsigned (&bits)[corners]) {
    CornerBits all = 0;
    for (int j = 0; j < corners; ++j) all |= CornerBits{bits[j]} << j * lanes;
    return all;
  }
  /// What holds of the next corner.
  static CornerBits of_next(CornerBits corner) {
    return corner >> lanes | (corner & all_lanes) << (width - lanes);
  }

  struct Integrals {
    Pack area, along, depth;  ///< −∫ 1, s, d dA
  };

  /// Depths of the slave's corners behind the master's sides, and their heights over the line of division at
  /// each master corner, positive on the side of the side that starts there.
  void measure(const LanePiece<corners>& master, const LanePiece<corners>& slave) {
    for (int k = 0; k < corners; ++k) {
      const Packs2 along = (k == 0 ? master.last_tangent : master.tangent[k - 1]) + master.tangent[k];
      behind_[k] = right_[k] = 0;
      for (int j = 0; j < corners; ++j) {
        const Packs2 from = slave.at[j] - master.at[k];
        depth_[k][j] = simd::cross(master.tangent[k], from);
        height_[k][j] = simd::dot(along, from);
        behind_[k] |= CornerBits{simd::bits(depth_[k][j] > 0.0)} << j * lanes;
        right_[k] |= CornerBits{simd::bits(height_[k][j] >= 0.0)} << j * lanes;
      }
      depth_[k][corners] = depth_[k][0];
      height_[k][corners] = height_[k][0];
    }
    for (int j = 0; j <= corners; ++j) height_[corners][j] = height_[0][j];
    right_[corners] = right_[0];
  }

  /// Slave sides that may reach into the cell of a master side: not all before it, not all on one side.
  CornerBits possible_meetings(int k) const {
    return (behind_[k] | of_next(behind_[k])) & (right_[k] | of_next(right_[k])) &
           ~(right_[k + 1] & of_next(right_[k + 1]));
  }

  /// The part of a slave side in a cell, by its parameters (Liang–Barsky).
  void cut_out(const LanePiece<corners>& master, const LanePiece<corners>& slave, int k, int j, Mask possible,
               Pack stiffness, Integrals& sum) {
    const Pack first = depth_[k][j], last = depth_[k][j + 1];
    const Pack left = height_[k][j], left_last = height_[k][j + 1];
    const Pack right = height_[k + 1][j], right_last = height_[k + 1][j + 1];
    const Pack surface = first / (first - last), before = left / (left - left_last),
               after = right / (right - right_last);

    Pack t0 = simd::select(first > 0.0, 0.0, surface), t1 = simd::select(last > 0.0, 1.0, surface);
    const Mask enters_left = (left < 0.0) & (before >= t0);
    t0 = simd::select(enters_left, before, t0);
    const Mask enters_right = (right >= 0.0) & (after >= t0);
    t0 = simd::select(enters_right, after, t0);
    const Mask leaves_left = (left_last < 0.0) & (before <= t1);
    t1 = simd::select(leaves_left, before, t1);
    const Mask leaves_right = (right_last >= 0.0) & (after <= t1);
    t1 = simd::select(leaves_right, after, t1);

    // Elsewhere the parameters may be no numbers at all.
    Mask valid = possible & (t0 <= t1);
    t0 = simd::only_where(valid, t0);
    t1 = simd::only_where(valid, t1);

    const Packs2 from = slave.at[j] - master.at[k], span = slave.at[j + 1] - slave.at[j];
    const Pack start_along = simd::dot(master.tangent[k], from),
               span_along = simd::dot(master.tangent[k], span);
    const Pack d0 = simd::max(0.0, first + t0 * (last - first)),
               d1 = simd::max(0.0, first + t1 * (last - first));
    const Pack s0 = start_along + t0 * span_along, s1 = start_along + t1 * span_along;

    const Mask clear0 = d0 <= master.clear_depth, clear1 = d1 <= master.clear_depth;
    deep = deep | (valid & ((clear0 & !clear1) | (clear1 & !clear0)));
    valid = valid & clear0;
    if (!simd::any(valid)) return;

    const Pack l = master.length[k], run = s1 - s0;
    // Distance along the side from the end that the line of division goes through; zero where there is none.
    const Pack in = simd::select(enters_right, s0 - l, simd::select(enters_left, s0, 0.0)),
               out = simd::select(leaves_right, s1 - l, simd::select(leaves_left, s1, 0.0));
    const Pack in_from = simd::select(enters_right, l, 0.0), out_from = simd::select(leaves_right, l, 0.0);
    const Pack in_area = in * d0 * 0.5, out_area = out * d1 * 0.5;
    const Pack third = 1.0 / 3.0, sixth = 1.0 / 6.0;
    sum.area = sum.area + simd::only_where(valid, run * (d0 + d1) * 0.5 + in_area - out_area);
    sum.along =
        sum.along + simd::only_where(valid, run * sixth * (s0 * (d0 + d0 + d1) + s1 * (d1 + d1 + d0)) +
                                                in_area * (in * (third + third) + in_from) -
                                                out_area * (out * (third + third) + out_from));
    sum.depth = sum.depth + simd::only_where(valid, run * sixth * (d0 * d0 + d0 * d1 + d1 * d1) +
                                                        in_area * d0 * third - out_area * d1 * third);

    LaneSegment& at = segment[segment_count_++];
    at.master_side = k;
    at.slave_side = j;
    at.valid = valid;
    at.start = t0;
    at.end = t1;
    at.start_lever = s0 * master.inverse_length[k];
    at.end_lever = s1 * master.inverse_length[k];
    at.length = simd::only_where(valid, (t1 - t0) * slave.length[j]);
    at.share = at.length * (d0 + d1) * 0.5;
    const Pack scale = stiffness * at.length * sixth;
    at.start_load = scale * (d0 + d0 + d1);
    at.end_load = scale * (d1 + d1 + d0);
    cell[cell_count].share = cell[cell_count].share + at.share;
    arc = arc + simd::only_where(valid, t1 - t0) * span;
    penetration = simd::max(penetration, simd::only_where(valid, simd::max(d0, d1)));
  }

  void close_cell(const LanePiece<corners>& master, Pack stiffness, const Integrals& sum) {
    LaneCell& now = cell[cell_count++];
    const int k = now.side;
    const Pack size = -sum.area;
    const Mask some = size > 0.0;
    deep = deep | (size < -1e-12 * master.length[k] * master.clear_depth);
    const Pack along = simd::only_where(some, -sum.along), depth = simd::only_where(some, -sum.depth);
    now.load = simd::only_where(some, stiffness * size);
    now.lever = simd::only_where(some, -sum.along / (size * master.length[k]));
    stored = stored + stiffness * depth;
    area = area + simd::only_where(some, size);
    const Packs2 t = master.tangent[k];  // inwards is (−t.y, t.x)
    moment_x = moment_x + simd::only_where(some, size) * master.at[k].x + along * t.x - depth * t.y;
    moment_y = moment_y + simd::only_where(some, size) * master.at[k].y + along * t.y + depth * t.x;
    force = force + now.load * master.normal(k);
  }

  Pack depth_[corners][corners + 1], height_[corners + 1][corners + 1];
  CornerBits behind_[corners], right_[corners + 1];
  int segment_count_ = 0;
};

}  // namespace TALUS_SIMD_LEVEL
}  // namespace talus::overlap
