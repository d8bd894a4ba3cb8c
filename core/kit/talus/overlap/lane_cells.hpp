#pragma once

#include <talus/overlap/lane_piece.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace talus::overlap {
inline namespace TALUS_SIMD_LEVEL {

/// A stretch of one slave side in the cell of one master side (Fig. 5). Lanes without it have a length of 0.
struct LaneSegment {
  LaneCorner* slave;            ///< where the side starts
  Pack start, end;              ///< along the slave side, 0 to 1
  Pack start_depth, end_depth;  ///< m, (2d₁ + d₂)/6 and (d₁ + 2d₂)/6: how a linear load goes to both ends
  Pack length;                  ///< m, along the slave
  Pack start_lever, end_lever;  ///< along the master side, 0 to 1; for dashpots alone
};

/// The cell of one master side.
struct LaneCell {
  LaneCorner* master;        ///< where the side starts
  LaneSegment *begin, *end;  ///< its segments
  Pack area;                 ///< m²
  Pack lever;                ///< of the point below the centroid on the side, 0 to 1
  Pack load, on_end;         ///< N/m, normal; the part that the end of the side carries
  Pack shear, shear_on_end;  ///< N/m, in proportion to which friction acts, and where

  Packs2 side() const { return master[1].at - master->at; }  ///< m
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
  Mask deep;
  Pack stored, penetration;  ///< J/m, m
  Pack area;                 ///< m², of the overlap
  Packs2 arc;                ///< m, sum of the segments along the slave
  Pack arc_length;           ///< m
  Packs2 force;              ///< N/m on the slave, of the springs
  Pack pattern;              ///< which sides meet, 4 · master side + slave side (of four) as bits

  std::span<LaneCell> cells() { return std::span(cell_).first(cell_count_); }
  std::span<const LaneCell> cells() const { return std::span(cell_).first(cell_count_); }

  /// Finds the cells and what their pressure comes to; either all lanes are mixed or none.
  template <int master_sides, int slave_sides>
  void find(LanePiece<corners>& master, LanePiece<corners>& slave, Pack stiffness, Pack clear_depth,
            bool damped) {
    damped_ = damped;
    deep = simd::nowhere();
    stored = penetration = area = arc_length = pattern = 0.0;
    arc = force = {0.0, 0.0};
    cell_count_ = 0;
    next_segment_ = segment_;
    constexpr int sides = corners_of(master_sides, corners), others = corners_of(slave_sides, corners);
    measure_heights<sides, others>(master, slave);
#pragma GCC unroll 1  // a cut is long enough
    for (int k = 0; k < sides; ++k) {
      const int after = k + 1 == sides ? 0 : k + 1;
      CornerBits meetings = some_right_[k] & ~all_right_[after];
      if constexpr (master_sides == mixed) meetings &= each_corner(master.real[k]) & in_turn(slave.real);
      if (meetings == 0 || !measure_depths<others>(master.corner[k], slave, clear_depth)) continue;
      meetings &= some_behind_;
      if (meetings == 0) continue;
      Integrals sum{0.0, 0.0, 0.0};
      LaneCell& cell = cell_[cell_count_];
      cell.master = &master.corner[k];
      cell.begin = next_segment_;
      const Pack inverse_length = 1.0 / cell.master->length;
      while (meetings != 0) {
        const int j = std::countr_zero(meetings) / lanes, shift = j * lanes;
        const CornerBits here = meetings >> shift & all_lanes;
        meetings ^= here << shift;
        const Mask possible = simd::mask_of(static_cast<unsigned>(here));
        const auto crossed = [&](int line) {
          return (here & (some_right_[line] & ~all_right_[line]) >> shift) != 0;
        };
        const Heights heights{height_[k], height_[after], j + 1 == others ? 0 : j + 1, crossed(k),
                              crossed(after)};
        cut_out(cell, slave, k, j, heights, possible, clear_depth, inverse_length, sum);
      }
      cell.end = next_segment_;
      if (cell.end != cell.begin) close_cell(cell, inverse_length, clear_depth, stiffness, sum);
    }
  }

 private:
  /// What holds of corners of the slave or of the sides that start there: bit j · lanes + lane.
  using CornerBits = std::uint64_t;
  static constexpr CornerBits all_lanes = (1u << lanes) - 1;

  static CornerBits each_corner(unsigned bits) {
    CornerBits all = bits;
    for (int shift = lanes; shift < corners * lanes; shift *= 2) all |= all << shift;
    return all;
  }
  static CornerBits in_turn(const unsigned (&bits)[corners]) {
    CornerBits all = 0;
    for (int j = 0; j < corners; ++j) all |= CornerBits{bits[j]} << j * lanes;
    return all;
  }
  /// What holds of the next corner of `count`.
  template <int count>
  static CornerBits of_next(CornerBits corner) {
    return corner >> lanes | (corner & all_lanes) << (count * lanes - lanes);
  }

  /// [4 · master side + slave side] what it adds to `pattern`.
  static constexpr double side_bit[16] = {0x1p0, 0x1p1, 0x1p2,  0x1p3,  0x1p4,  0x1p5,  0x1p6,  0x1p7,
                                          0x1p8, 0x1p9, 0x1p10, 0x1p11, 0x1p12, 0x1p13, 0x1p14, 0x1p15};

  struct Integrals {
    Pack area, along, depth;  ///< −∫ 1, s, d dA
  };

  /// Of the slave's corners over the lines of division at both ends of a master side.
  struct Heights {
    const Pack *left, *right;
    int last;                          ///< the corner at the end of the slave side at hand
    bool left_crossed, right_crossed;  ///< the side goes through the line, in a lane at least
  };

  /// Heights of the slave's corners over the line of division at each master corner, positive on the side of
  /// the side that starts there.
  template <int sides, int others>
  void measure_heights(const LanePiece<corners>& master, const LanePiece<corners>& slave) {
    for (int k = 0; k < sides; ++k) {
      const LaneCorner& at = master.corner[k];
      const Packs2 along = (k == 0 ? master.last_tangent : master.corner[k - 1].tangent) + at.tangent;
      CornerBits right = 0;
      for (int j = 0; j < others; ++j) {
        height_[k][j] = simd::dot(along, slave.corner[j].at - at.at);
        right |= CornerBits{simd::bits(height_[k][j] >= 0.0)} << j * lanes;
      }
      const CornerBits right_of_next = of_next<others>(right);
      some_right_[k] = right | right_of_next;
      all_right_[k] = right & right_of_next;
    }
  }

  /// Depths of the slave's corners behind a side of the master. False if all are deeper than clear_depth.
  template <int others>
  bool measure_depths(const LaneCorner& side, const LanePiece<corners>& slave, Pack clear_depth) {
    Pack least = clear_depth;
    CornerBits behind = 0;
    for (int j = 0; j < others; ++j) {
      depth_[j] = side.depth(slave.corner[j].at);
      least = simd::min(least, depth_[j]);
      behind |= CornerBits{simd::bits(depth_[j] > 0.0)} << j * lanes;
    }
    some_behind_ = behind | of_next<others>(behind);
    return simd::any(least < clear_depth);
  }

  /// The part of a slave side in a cell, by its parameters (Liang–Barsky).
  [[gnu::always_inline]] void cut_out(LaneCell& cell, LanePiece<corners>& slave, int k, int j,
                                      const Heights& heights, Mask possible, Pack clear_depth,
                                      Pack inverse_length, Integrals& sum) {
    const LaneCorner& master = *cell.master;
    LaneCorner& side = slave.corner[j];
    const Pack first = depth_[j], last = depth_[heights.last];
    const Pack surface = first / (first - last);
    Pack t0 = simd::select(first > 0.0, 0.0, surface), t1 = simd::select(last > 0.0, 1.0, surface);
    Mask enters_left = simd::nowhere(), enters_right = enters_left, leaves_left = enters_left,
         leaves_right = enters_left;
    if (heights.left_crossed) {
      const Pack left = heights.left[j], left_last = heights.left[heights.last];
      const Pack before = left / (left - left_last);
      enters_left = (left < 0.0) & (before >= t0);
      t0 = simd::select(enters_left, before, t0);
      leaves_left = (left_last < 0.0) & (before <= t1);
      t1 = simd::select(leaves_left, before, t1);
    }
    if (heights.right_crossed) {
      const Pack right = heights.right[j], right_last = heights.right[heights.last];
      const Pack after = right / (right - right_last);
      enters_right = (right >= 0.0) & (after >= t0);
      t0 = simd::select(enters_right, after, t0);
      leaves_right = (right_last >= 0.0) & (after <= t1);
      t1 = simd::select(leaves_right, after, t1);
    }

    Mask valid = possible & (t0 <= t1);
    if (!simd::any(valid)) return;
    Pack d0 = first + t0 * (last - first), d1 = first + t1 * (last - first);
    const Mask clear0 = d0 <= clear_depth, clear1 = d1 <= clear_depth;
    deep = deep | (valid & ((clear0 & !clear1) | (clear1 & !clear0)));
    valid = valid & clear0;
    // Elsewhere the parameters may be no numbers at all; with zeros all that follows comes to nothing.
    t0 = simd::only_where(valid, t0);
    t1 = simd::only_where(valid, t1);
    d0 = simd::only_where(valid, simd::max(0.0, d0));
    d1 = simd::only_where(valid, simd::max(0.0, d1));

    const Packs2 from = side.at - master.at, span = (&side)[1].at - side.at;
    const Pack start_along = simd::dot(master.tangent, from), span_along = simd::dot(master.tangent, span);
    const Pack s0 = start_along + t0 * span_along, s1 = start_along + t1 * span_along;

    const Pack l = master.length, run = s1 - s0;
    // Distance along the side from the end that the line of division goes through; zero where there is none.
    const Pack in = simd::select(enters_right, s0 - l, simd::select(enters_left, s0, 0.0)),
               out = simd::select(leaves_right, s1 - l, simd::select(leaves_left, s1, 0.0));
    const Pack in_from = simd::select(enters_right, l, 0.0), out_from = simd::select(leaves_right, l, 0.0);
    const Pack in_area = in * d0 * 0.5, out_area = out * d1 * 0.5;
    const Pack third = 1.0 / 3.0, sixth = 1.0 / 6.0;
    const Pack start_depth = sixth * (d0 + d0 + d1), end_depth = sixth * (d1 + d1 + d0);
    sum.area = sum.area + run * (d0 + d1) * 0.5 + in_area - out_area;
    sum.along = sum.along + run * (s0 * start_depth + s1 * end_depth) +
                in_area * (in * (third + third) + in_from) - out_area * (out * (third + third) + out_from);
    sum.depth = sum.depth + run * sixth * (d0 * d0 + d0 * d1 + d1 * d1) + in_area * d0 * third -
                out_area * d1 * third;

    LaneSegment& at = *next_segment_++;
    const Pack part = t1 - t0;
    at.slave = &side;
    at.start = t0;
    at.end = t1;
    at.start_depth = start_depth;
    at.end_depth = end_depth;
    at.length = part * side.length;
    if (damped_) {
      at.start_lever = s0 * inverse_length;
      at.end_lever = s1 * inverse_length;
    }
    arc = arc + part * span;
    arc_length = arc_length + at.length;
    penetration = simd::max(penetration, simd::max(d0, d1));
    pattern = pattern + simd::only_where(valid, side_bit[k % 4 * 4 + j % 4]);
  }

  /// Eqs. 28–29: on the master through the centroid of the cell.
  [[gnu::always_inline]] void close_cell(LaneCell& now, Pack inverse_length, Pack clear_depth, Pack stiffness,
                                         const Integrals& sum) {
    ++cell_count_;
    const LaneCorner& side = *now.master;
    const Pack size = -sum.area;
    const Mask some = size > 0.0;
    deep = deep | (size < -1e-12 * side.length * clear_depth);
    now.area = simd::only_where(some, size);
    now.lever = simd::only_where(some, -sum.along / size * inverse_length);
    now.load = stiffness * now.area;
    now.on_end = now.load * now.lever;
    stored = stored - stiffness * simd::only_where(some, sum.depth);
    area = area + now.area;
    force = force + now.load * side.normal();
  }

  Pack depth_[corners], height_[corners][corners];
  CornerBits some_behind_;  ///< sides of the slave with an end behind the side of the master at hand
  CornerBits some_right_[corners], all_right_[corners];  ///< with one end, both ends of positive height
  LaneCell cell_[corners];
  LaneSegment segment_[corners * corners];  ///< cell after cell
  std::size_t cell_count_ = 0;
  bool damped_ = false;
  LaneSegment* next_segment_ = segment_;
};

}  // namespace TALUS_SIMD_LEVEL
}  // namespace talus::overlap
