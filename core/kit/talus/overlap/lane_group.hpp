#pragma once

#include <talus/contact_model.hpp>
#include <talus/overlap/cell_loads.hpp>
#include <talus/overlap/friction.hpp>
#include <talus/overlap/lane_piece.hpp>

namespace talus::overlap {
inline namespace TALUS_SIMD_LEVEL {

/// A pair whose pieces may overlap. Corners are counted from the side that faces the other piece most, as
/// side 1, so that the lanes of a group work on the same sides.
struct TouchingPair {
  std::uint32_t pair;
  /// 1 + start of body a + 8 start of body b + 64 pattern, as the history holds it. The pattern tells which
  /// sides met a step ago, 4 · master side + slave side as bits; of more than four sides, a number that is
  /// alike where those are. It only decides who shares a group.
  std::uint32_t code;

  static constexpr double pattern_unit = 64;
  /// Added to a code of an earlier step: nobody has looked whether the pieces overlap.
  static constexpr std::uint32_t unseen_bit = 1u << 31;

  static TouchingPair remembered(std::uint32_t pair, double code) {
    return {pair, static_cast<std::uint32_t>(code) | unseen_bit};
  }
  static TouchingPair seen(std::uint32_t pair, std::uint32_t start_a, std::uint32_t start_b) {
    return {pair, 1 + start_a + 8 * start_b};
  }
  std::uint32_t start(int body) const { return (code - 1) >> (3 * body) & 7; }
  std::uint32_t starts() const { return ((code - 1) & 63) + 1; }
  std::uint32_t pattern() const { return ((code - 1) & ~unseen_bit) >> 6; }
  bool unseen() const { return code >= unseen_bit; }
};

inline constexpr double no_history[8] = {0, 0, 0, 0, 0, 0, 0, 0};

/// The pairs of a group, a lane each, as the host's arrays know them. Piece 0 is the master, where only one
/// is.
struct LaneGroup {
  int count;
  std::uint32_t pair[lanes];
  bool swapped[lanes];  ///< piece 0 is that of body b
  LanePieces pieces[2];
  Pack normal_stiffness, tangential_stiffness, friction, normal_damping, tangential_damping;
  alignas(64) double reduced_mass[lanes], side[lanes], starts[lanes];
  const double* history[lanes];  ///< of the previous step, or zeros
  std::uint32_t slot[lanes], load_start[lanes];

  /// Fills the lanes from `touching`; those beyond `count` repeat the first.
  template <class Law>
  void collect(const Law& law, const ContactBatch& batch, const TouchingPair* touching, int touching_count) {
    count = touching_count;
    std::uint32_t row[lanes];
    bool alike = true;
    for (int lane = 0; lane < lanes; ++lane) {
      const TouchingPair& touch = touching[lane < count ? lane : 0];
      const BodyPair& at = batch.pairs[touch.pair];
      const PiecePair& piece = batch.piece_pairs[at.piece_pair_start];
      pair[lane] = touch.pair;
      swapped[lane] = at.master_share == 0;
      side[lane] = swapped[lane] ? -1 : 1;
      const int a = swapped[lane] ? 1 : 0;
      pieces[a].set(lane, batch.boundaries, piece.a, 0, 0, touch.start(0));
      pieces[1 - a].set(lane, batch.boundaries, piece.b, at.offset_x, at.offset_y, touch.start(1));
      reduced_mass[lane] = at.reduced_mass;
      starts[lane] = touch.starts();
      slot[lane] = at.slot_start;
      load_start[lane] = piece.load_start;
      if constexpr (Law::frictional)
        history[lane] = at.contact_count == 0 ? no_history : batch.history + at.slot_start * friction_doubles;
      row[lane] = batch.interfaces.row[pieces[a].first[lane]->surface * batch.interfaces.surface_count +
                                       pieces[1 - a].first[lane]->surface];
      alike = alike && row[lane] == row[0];
    }
    read_parameters(law, batch.interfaces, row, alike);
  }

  /// Loads of the lanes on their corners, from those on both pieces.
  template <int corners, bool full>
  void write_loads(const ContactLoads& loads, unsigned refused, const Packs2 (&load)[2][corners + 1]) const {
    double *x[2][lanes], *y[2][lanes];  // by piece
    for (int lane = 0; lane < lanes; ++lane) {
      const std::uint32_t begin = load_start[lane];
      const int a = swapped[lane] ? 1 : 0;
      x[a][lane] = loads.fx + begin;
      y[a][lane] = loads.fy + begin;
      // Of a pair of bodies that are one piece each, the first has its loads before those of the second.
      const std::uint32_t first = full ? corners : pieces[a].corners_in[lane];
      x[1 - a][lane] = x[a][lane] + first;
      y[1 - a][lane] = y[a][lane] + first;
    }
    const bool all = refused == 0 && count == lanes;
    for (int p = 0; p < 2; ++p) {
      if constexpr (full && corners == 4) {
        if (all) {
          write_quadrilaterals(pieces[p], load[p], x[p], y[p]);
          continue;
        }
      }
      write_any<corners>(pieces[p], refused, load[p], x[p], y[p]);
    }
  }

 private:
  template <class Law>
  void read_parameters(const Law& law, const Interfaces& interfaces, const std::uint32_t* row, bool alike) {
    alignas(64) double value[5][lanes];
    const int different = alike ? 1 : lanes;
    for (int lane = 0; lane < different; ++lane) {
      const InterfaceParameters parameters =
          law.interface(interfaces.value + row[lane] * interfaces.parameter_count);
      value[0][lane] = parameters.normal_stiffness;
      value[1][lane] = parameters.tangential_stiffness;
      value[2][lane] = parameters.friction;
      value[3][lane] = parameters.normal_damping;
      value[4][lane] = parameters.tangential_damping;
    }
    const auto read = [&](int i) { return alike ? Pack(value[i][0]) : simd::load(value[i]); };
    normal_stiffness = read(0);
    tangential_stiffness = read(1);
    friction = read(2);
    normal_damping = read(3);
    tangential_damping = read(4);
  }

  /// All lanes have four corners: counts them from the host's first again, in two turns.
  static void write_quadrilaterals(const LanePieces& piece, const Packs2* load, double* const* x,
                                   double* const* y) {
    unsigned by_one = 0, by_two = 0;
    for (int lane = 0; lane < lanes; ++lane) {
      const std::uint32_t start = piece.start_in[lane];
      by_one |= (start & 1) << lane;
      by_two |= (start >> 1) << lane;
    }
    const Mask one = simd::mask_of(by_one), two = simd::mask_of(by_two);
    Packs2 turned[4], back[4];
    for (int i = 0; i < 4; ++i) turned[i] = simd::select(one, load[(i + 3) % 4], load[i]);
    for (int i = 0; i < 4; ++i) back[i] = simd::select(two, turned[(i + 2) % 4], turned[i]);
    const Pack back_x[4] = {back[0].x, back[1].x, back[2].x, back[3].x},
               back_y[4] = {back[0].y, back[1].y, back[2].y, back[3].y};
    simd::scatter_rows(back_x, x);
    simd::scatter_rows(back_y, y);
  }

  /// Load that came to the repeated first corner of a piece with fewer corners goes to that corner.
  template <int corners>
  void write_any(const LanePieces& piece, unsigned refused, const Packs2* load, double* const* to_x,
                 double* const* to_y) const {
    alignas(64) double x[corners][lanes], y[corners][lanes];
    for (int i = 0; i < corners; ++i) {
      simd::store(load[i].x, x[i]);
      simd::store(load[i].y, y[i]);
    }
    for (int lane = 0; lane < count; ++lane) {
      if ((refused >> lane & 1) != 0) continue;
      const auto size = static_cast<int>(piece.corners_in[lane]);
      for (int i = size; i < corners; ++i) {
        x[0][lane] += x[i][lane];
        y[0][lane] += y[i][lane];
      }
      auto corner = static_cast<int>(piece.start_in[lane]);
      for (int i = 0; i < size; ++i) {
        to_x[lane][corner] = x[i][lane];
        to_y[lane][corner] = y[i][lane];
        if (++corner == size) corner = 0;
      }
    }
  }
};

}  // namespace TALUS_SIMD_LEVEL
}  // namespace talus::overlap
