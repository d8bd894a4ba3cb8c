#pragma once

#include <talus/overlap/lane_piece.hpp>

namespace talus::overlap {
inline namespace TALUS_SIMD_LEVEL {

/// Loads at the corners of both pieces of a pair, N/m.
template <int corners>
struct LaneLoads {
  Packs2 at[2][corners + 1];  ///< entry `corners` is added to entry 0 in the end

  void clear() {
    for (auto& piece : at) {
      for (Packs2& load : piece) load = {0.0, 0.0};
    }
  }
  void add(int piece, int corner, Pack size, Packs2 direction) {
    at[piece][corner] = at[piece][corner] + size * direction;
  }
};

/// A stretch of one slave side in the cell of one master side (Fig. 5).
struct LaneSegment {
  Mask valid;
  Pack start, end;              ///< along the slave side, 0 to 1
  Pack start_lever, end_lever;  ///< along the master side, 0 to 1
  Pack start_load, end_load;    ///< N/m, trapezoid load as two end loads
  Pack length, share;           ///< m; m², its part of the area below it
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
  Pack load[corners];                     ///< N/m on the master side, normal
  Pack lever[corners];                    ///< where on the side, 0 to 1
  Pack share[corners];                    ///< m², sum over the segments
  LaneSegment segment[corners][corners];  ///< [master side][slave side], where `used`
  bool used[corners][corners];
  bool side_used[corners];
  Mask deep;
  Pack stored, penetration;       ///< J/m, m
  Pack area, moment_x, moment_y;  ///< m², m³: of the overlap, first moments
  Packs2 arc;                     ///< m, sum of the segments along the slave
  Packs2 force;                   ///< N/m on the slave

  void find(const LanePiece<corners>& master, const LanePiece<corners>& slave, Pack stiffness) {
    deep = simd::nowhere();
    stored = penetration = area = moment_x = moment_y = 0.0;
    arc = force = {0.0, 0.0};
    Pack left[corners + 1], right[corners + 1];
    for (int k = 0; k < corners; ++k) {
      if (k == 0) measure_division(master, 0, slave, left);
      measure_division(master, k + 1, slave, right);
      find_cell(master, k, slave, left, right, stiffness);
      for (int j = 0; j <= corners; ++j) left[j] = right[j];
    }
  }

 private:
  /// Signed height over the line of division at a master corner: positive on the side of side k.
  static void measure_division(const LanePiece<corners>& master, int k, const LanePiece<corners>& slave,
                               Pack* height) {
    const Packs2 along =
        (k == 0 || k == corners ? master.last_tangent : master.tangent[k - 1]) + master.tangent[k];
    for (int j = 0; j < corners; ++j) height[j] = simd::dot(along, slave.at[j] - master.at[k]);
    height[corners] = height[0];
  }

  void find_cell(const LanePiece<corners>& master, int k, const LanePiece<corners>& slave, const Pack* left,
                 const Pack* right, Pack stiffness) {
    load[k] = lever[k] = share[k] = 0.0;
    side_used[k] = false;
    for (int j = 0; j < corners; ++j) used[k][j] = false;
    Pack depth[corners + 1];
    Mask behind = simd::nowhere();
    for (int j = 0; j < corners; ++j) {
      depth[j] = master.depth(k, slave.at[j]);
      behind = behind | (depth[j] > 0.0);
    }
    if (!simd::any(behind & master.real[k])) return;
    depth[corners] = depth[0];

    Integrals sum{0.0, 0.0, 0.0};
    for (int j = 0; j < corners; ++j) {
      const Mask possible = master.real[k] & slave.real[j] & ((depth[j] > 0.0) | (depth[j + 1] > 0.0)) &
                            ((left[j] >= 0.0) | (left[j + 1] >= 0.0)) &
                            ((right[j] < 0.0) | (right[j + 1] < 0.0));
      if (simd::any(possible)) cut_out(master, k, slave, j, depth, left, right, possible, stiffness, sum);
    }
    close_cell(master, k, stiffness, sum);
  }

  struct Integrals {
    Pack area, along, depth;  ///< −∫ 1, s, d dA
  };

  /// The part of slave side j in cell k, by its parameters (Liang–Barsky).
  void cut_out(const LanePiece<corners>& master, int k, const LanePiece<corners>& slave, int j,
               const Pack* depth, const Pack* left, const Pack* right, Mask possible, Pack stiffness,
               Integrals& sum) {
    const Pack first = depth[j], last = depth[j + 1];
    const Pack surface = first / (first - last), before = left[j] / (left[j] - left[j + 1]),
               after = right[j] / (right[j] - right[j + 1]);
    const Mask begins_in = first > 0.0, ends_in = last > 0.0;
    const Mask begins_right_of = left[j] >= 0.0, ends_right_of = left[j + 1] >= 0.0;
    const Mask begins_left_of = right[j] < 0.0, ends_left_of = right[j + 1] < 0.0;

    Pack t0 = simd::select(begins_in, 0.0, surface), t1 = simd::select(ends_in, 1.0, surface);
    const Mask enters_left = !begins_right_of & (before >= t0);
    t0 = simd::select(enters_left, before, t0);
    const Mask enters_right = !begins_left_of & (after >= t0);
    t0 = simd::select(enters_right, after, t0);
    const Mask leaves_left = !ends_right_of & (before <= t1);
    t1 = simd::select(leaves_left, before, t1);
    const Mask leaves_right = !ends_left_of & (after <= t1);
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

    LaneSegment& at = segment[k][j];
    used[k][j] = side_used[k] = true;
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
    share[k] = share[k] + at.share;
    arc = arc + simd::only_where(valid, t1 - t0) * span;
    penetration = simd::max(penetration, simd::only_where(valid, simd::max(d0, d1)));
  }

  void close_cell(const LanePiece<corners>& master, int k, Pack stiffness, const Integrals& sum) {
    if (!side_used[k]) return;
    const Pack cell = -sum.area;
    const Mask some = cell > 0.0;
    deep = deep | (cell < -1e-12 * master.length[k] * master.clear_depth);
    const Pack along = simd::only_where(some, -sum.along), depth = simd::only_where(some, -sum.depth);
    load[k] = simd::only_where(some, stiffness * cell);
    lever[k] = simd::only_where(some, -sum.along / (cell * master.length[k]));
    stored = stored + stiffness * depth;
    area = area + simd::only_where(some, cell);
    const Packs2 t = master.tangent[k];  // inwards is (−t.y, t.x)
    moment_x = moment_x + simd::only_where(some, cell) * master.at[k].x + along * t.x - depth * t.y;
    moment_y = moment_y + simd::only_where(some, cell) * master.at[k].y + along * t.y + depth * t.x;
    force = force + load[k] * master.normal(k);
  }
};

}  // namespace TALUS_SIMD_LEVEL
}  // namespace talus::overlap
