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
  /// Added once where the master has three corners, twice where the slave has: those share a group, too.
  static constexpr std::uint32_t shape_unit = 1u << 24;

  static TouchingPair remembered(std::uint32_t pair, double code) {
    return {pair, static_cast<std::uint32_t>(code) | unseen_bit};
  }
  static TouchingPair seen(std::uint32_t pair, std::uint32_t start_a, std::uint32_t start_b) {
    return {pair, 1 + start_a + 8 * start_b};
  }
  std::uint32_t pattern() const { return ((code - 1) & ~unseen_bit & ~(3 * shape_unit)) >> 6; }
  std::uint32_t shape() const { return code / shape_unit & 3; }
  bool unseen() const { return code >= unseen_bit; }
};

/// The pairs of a group, a lane each, as the host's arrays know them. Piece 0 is the master, where only one
/// is.
struct LaneGroup {
  const TouchingPair* touching;  ///< [lanes]; those from `count` on are there to fill the lanes
  int count;
  LanePairs pairs;
  Numbers swapped;  ///< not 0 where piece 0 is that of body b
  LanePieces pieces[2];
  Pack reduced_mass, clear_depth;
  Pack normal_stiffness, tangential_stiffness, friction, normal_damping, tangential_damping;
  Pack starts;      ///< code without pattern, as TouchingPair::remembered() reads it
  Mask remembered;  ///< in contact a step ago

  std::uint32_t pair(int lane) const { return touching[lane].pair; }
  /// Where the history of a lane is, in that of all.
  std::size_t kept(int lane) const { return std::size_t{pairs.at[lane]->slot_start} * friction_doubles; }

  template <class Law>
  void collect(const Law& law, const ContactBatch& batch, const TouchingPair* group, int group_count) {
    touching = group;
    count = group_count;
    const double* place[lanes];
    for (int lane = 0; lane < lanes; ++lane) {
      pairs.at[lane] = batch.pairs + pair(lane);
      place[lane] = &pairs.at[lane]->offset_x;
    }
    remembered = simd::nonzero(pairs.contact_count());

    Numbers code;
    std::memcpy(&code, touching, sizeof code);
    code = (code >> 32) - 1;
    starts = simd::as_pack((code & 63) + 1);
    const LanePairs::FirstCorners first = pairs.first_corners();
    swapped = pairs.read(offsetof(BodyPair, master_share)) == 0 ? ~Numbers{} : Numbers{};
    const auto swap = [&](const Numbers& p, const Numbers& q) { return (p & ~swapped) | (q & swapped); };
    const Numbers start_a = (code & 7) * sizeof(BoundaryCorner),
                  start_b = (code >> 3 & 7) * sizeof(BoundaryCorner);
    pieces[0].first = swap(first.a, first.b);
    pieces[1].first = swap(first.b, first.a);
    pieces[0].start = swap(start_a, start_b);
    pieces[1].start = swap(start_b, start_a);
    const LanePairs::CornerCounts counts = pairs.corner_counts();
    pieces[0].count = swap(counts.a, counts.b);
    pieces[1].count = swap(counts.b, counts.a);
    pieces[0].corner = pieces[1].corner = batch.boundaries.corner;

    Pack placed[4];
    simd::gather_rows(place, placed);
    const Mask of_b = simd::nonzero(swapped);
    const Packs2 offset{placed[0], placed[1]}, none{0.0, 0.0};
    pieces[0].offset = simd::select(of_b, offset, none);
    pieces[1].offset = simd::select(of_b, none, offset);
    reduced_mass = placed[2];
    clear_depth = placed[3];
    read_parameters(law, batch.interfaces);
  }

  /// 0: piece p of a lane is that of body a, 1: of b.
  int body(int p, int lane) const { return swapped[lane] != 0 ? 1 - p : p; }
  /// Of a pair of bodies that are one piece each, the first has its loads before those of the second.
  std::uint32_t load_start(int p, int lane) const {
    const BodyPair& pair_here = *pairs.at[lane];
    return pair_here.load_start + (body(p, lane) == 0 ? 0U : pair_here.plain_corners[0]);
  }

  /// Loads of the lanes on their corners, from those on both pieces.
  template <int corners, int sides, int other_sides>
  void write_loads(const ContactLoads& loads, unsigned refused, const LanePiece<corners>* piece) const {
    if constexpr (sides != mixed) {
      if (refused == 0 && count == lanes) {
        write_rows<sides>(loads, 0, piece[0].corner);
        write_rows<other_sides>(loads, 1, piece[1].corner);
        return;
      }
    }
    write_any<corners_of(sides, corners)>(loads, 0, refused, piece[0].corner);
    write_any<corners_of(other_sides, corners)>(loads, 1, refused, piece[1].corner);
  }

 private:
  template <class Law>
  void read_parameters(const Law& law, const Interfaces& interfaces) {
    alignas(64) double value[5][lanes];
    std::uint32_t other_row = 0;
    for (const BodyPair* at : pairs.at) other_row |= at->interface_row ^ pairs.at[0]->interface_row;
    const bool alike = other_row == 0;
    const int different = alike ? 1 : lanes;
    for (int lane = 0; lane < different; ++lane) {
      const InterfaceParameters parameters =
          law.interface(interfaces.value + pairs.at[lane]->interface_row * interfaces.parameter_count);
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

  /// All lanes are there and have three or four corners.
  template <int sides>
  void write_rows(const ContactLoads& loads, int p, const LaneCorner* corner) const {
    double *x[lanes], *y[lanes];
    const Numbers after = p == 0 ? swapped : ~swapped;
    const Numbers begin =
        (pairs.read(offsetof(BodyPair, load_start)) & 0xFFFFFFFF) + (after & pieces[1 - p].count);
    for (int lane = 0; lane < lanes; ++lane) {
      x[lane] = loads.fx + begin[lane];
      y[lane] = loads.fy + begin[lane];
    }
    const Numbers start = pieces[p].start_corner();
    const Pack load_x[4] = {corner[0].load.x, corner[1].load.x, corner[2].load.x, corner[3].load.x},
               load_y[4] = {corner[0].load.y, corner[1].load.y, corner[2].load.y, corner[3].load.y};
    simd::scatter_turned_rows<sides>(load_x, start, x);
    simd::scatter_turned_rows<sides>(load_y, start, y);
  }

  /// Load that came to the repeated first corner of a piece with fewer corners goes to that corner.
  template <int corners>
  void write_any(const ContactLoads& loads, int p, unsigned refused, const LaneCorner* from) const {
    alignas(64) double x[corners][lanes], y[corners][lanes];
    for (int i = 0; i < corners; ++i) {
      simd::store(from[i].load.x, x[i]);
      simd::store(from[i].load.y, y[i]);
    }
    const Numbers start = pieces[p].start_corner();
    for (int lane = 0; lane < count; ++lane) {
      if ((refused >> lane & 1) != 0) continue;
      const int size = pairs.at[lane]->plain_corners[body(p, lane)];
      for (int i = size; i < corners; ++i) {
        x[0][lane] += x[i][lane];
        y[0][lane] += y[i][lane];
      }
      const std::uint32_t begin = load_start(p, lane);
      auto corner = static_cast<std::uint32_t>(start[lane]);
      for (int i = 0; i < size; ++i) {
        loads.fx[begin + corner] = x[i][lane];
        loads.fy[begin + corner] = y[i][lane];
        if (++corner == static_cast<std::uint32_t>(size)) corner = 0;
      }
    }
  }
};

}  // namespace TALUS_SIMD_LEVEL
}  // namespace talus::overlap
