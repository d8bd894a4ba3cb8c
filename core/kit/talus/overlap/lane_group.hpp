#pragma once

#include <talus/contact_model.hpp>
#include <talus/overlap/cell_loads.hpp>
#include <talus/overlap/lane_piece.hpp>

#include <algorithm>
#include <bit>

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
  std::uint32_t start(int body) const { return (code - 1) >> 3 * body & 7; }
  bool unseen() const { return code >= unseen_bit; }
  bool averaged(const ContactBatch& batch) const { return batch.pairs[pair].master_share() == 0.5; }
};

using LaneBits = std::uint32_t;  ///< bit i says lane i
inline constexpr LaneBits all_lanes = (1u << lanes) - 1;

/// Calls visit(lane) for the lanes of `bits`, rising.
template <class Visit>
inline void each_lane(LaneBits bits, const Visit& visit) {
  for (int lane = 0; bits >> lane != 0; ++lane) {
    if ((bits >> lane & 1) != 0) visit(lane);
  }
}

/// Pairs that go through the lanes together, a lane each, for as long as the host's arrays stay as they are.
/// Piece 0 is the master, where only one is.
template <int corners>
struct LaneGroup {
  LaneBits live;        ///< lanes that stand for a pair
  LaneBits unseen;      ///< nobody has looked in this step whether the pieces overlap
  LaneBits remembered;  ///< in contact a step ago
  LaneBits swapped;     ///< piece 0 is that of body b
  bool averaged;        ///< both roles count half
  bool alike;           ///< all have one interface
  int sides[2];         ///< LanePlaces::sides()
  LanePlaces places[2];
  std::uint32_t pair[lanes];                            ///< in the batch
  std::uint32_t slot[lanes];                            ///< of its contact
  std::uint32_t interface_row[lanes];                   ///< Interfaces::row
  alignas(64) double offset_x[lanes], offset_y[lanes];  ///< m, of the piece of body b
  alignas(64) double reduced_mass[lanes], clear_depth[lanes];
  alignas(64) double starts[lanes];  ///< code without pattern, as TouchingPair::remembered() reads it

  /// m, to be added to the places of a piece.
  Packs2 offset(int piece) const {
    const Mask of_b = simd::mask_of(piece == 0 ? swapped : all_lanes & ~swapped);
    return {simd::only_where(of_b, simd::load(offset_x)), simd::only_where(of_b, simd::load(offset_y))};
  }

  /// Fills all lanes, those beyond the `count`-th pair with the first.
  void take(const ContactBatch& batch, const TouchingPair* touching, int count) {
    live = unseen = remembered = swapped = 0;
    averaged = touching[0].averaged(batch);
    for (int lane = 0; lane < lanes; ++lane) place(batch, touching[lane < count ? lane : 0], lane);
    live = (1u << count) - 1;
    compare();
  }

  /// Puts a pair into a lane that stands for none, if it is of the shape of the others.
  bool take_in(const ContactBatch& batch, const TouchingPair& touching) {
    if (live == all_lanes || touching.averaged(batch) != averaged) return false;
    const BodyPair& at = batch.pairs[touching.pair];
    for (int p = 0; p < 2; ++p) {
      if (sides[p] != mixed &&
          at.plain_corners[at.master_share() == 0 ? 1 - p : p] != static_cast<std::uint32_t>(sides[p]))
        return false;
    }
    place(batch, touching, std::countr_one(live));
    compare();
    return true;
  }

  /// Loads of the lanes of `wanted` on their corners, from those on both pieces.
  template <int sides, int other_sides>
  void write_loads(const ContactLoads& loads, LaneBits wanted, const LaneRows<corners>* rows,
                   const LanePiece<corners>* piece) const {
    if constexpr (sides != mixed) {
      write_alike<sides>(loads, wanted, rows[0], piece[0].corner);
      write_alike<other_sides>(loads, wanted, rows[1], piece[1].corner);
    } else {
      write_any(loads, 0, wanted, piece[0].corner);
      write_any(loads, 1, wanted, piece[1].corner);
    }
  }

 private:
  void place(const ContactBatch& batch, const TouchingPair& touching, int lane) {
    const BodyPair& at = batch.pairs[touching.pair];
    const bool swap = at.master_share() == 0;
    const auto mark = [&](LaneBits& bits, bool is_so) {
      bits = (bits & ~(1u << lane)) | (is_so ? 1u : 0u) << lane;
    };
    mark(live, true);
    mark(unseen, touching.unseen());
    mark(remembered, at.contact_count != 0);
    mark(swapped, swap);
    pair[lane] = touching.pair;
    slot[lane] = at.slot_start;
    interface_row[lane] = at.interface_row;
    for (int body = 0; body < 2; ++body) {
      const int piece = swap ? 1 - body : body;
      // Of a pair of bodies that are one piece each, the first has its loads before those of the second.
      const std::uint32_t load_start = at.load_start + (body == 0 ? 0U : at.plain_corners[0]);
      places[piece].load_shift[lane] = load_start - at.corner_start[body];
      places[piece].place(lane, at.corner_start[body], at.plain_corners[body], touching.start(body));
    }
    offset_x[lane] = at.offset_x;
    offset_y[lane] = at.offset_y;
    reduced_mass[lane] = at.reduced_mass;
    clear_depth[lane] = at.clear_depth;
    starts[lane] = 1 + touching.start(0) + 8 * touching.start(1);
  }

  void compare() {
    for (int p = 0; p < 2; ++p) sides[p] = places[p].sides();
    std::uint32_t other = 0;
    for (const std::uint32_t row : interface_row) other |= row ^ interface_row[0];
    alike = other == 0;
  }

  /// Of lanes that all have three or four corners.
  template <int sides>
  static void write_alike(const ContactLoads& loads, LaneBits wanted, const LaneRows<corners>& rows,
                          const LaneCorner* corner) {
    double* const first = reinterpret_cast<double*>(loads.corner);
    double* to[lanes];
    if (wanted == all_lanes) {
      for (int i = 0; i < sides; ++i) {
        for (int lane = 0; lane < lanes; ++lane) to[lane] = first + rows.load[i][lane];
        simd::scatter_points(corner[i].load, to);
      }
      return;
    }
    CornerLoad beside;
    for (int i = 0; i < sides; ++i) {
      for (int lane = 0; lane < lanes; ++lane)
        to[lane] = (wanted >> lane & 1) != 0 ? first + rows.load[i][lane] : &beside.x;
      simd::scatter_points(corner[i].load, to);
    }
  }

  /// Load that came to the repeated first corner of a piece with fewer corners goes to that corner.
  void write_any(const ContactLoads& loads, int p, LaneBits wanted, const LaneCorner* from) const {
    alignas(64) double x[corners][lanes], y[corners][lanes];
    for (int i = 0; i < corners; ++i) {
      simd::store(from[i].load.x, x[i]);
      simd::store(from[i].load.y, y[i]);
    }
    each_lane(wanted, [&](int lane) {
      const auto size = static_cast<int>(places[p].count[lane]);
      for (int i = size; i < corners; ++i) {
        x[0][lane] += x[i][lane];
        y[0][lane] += y[i][lane];
      }
      CornerLoad* const to = loads.corner + std::uint32_t{places[p].first[lane] + places[p].load_shift[lane]};
      auto corner = static_cast<int>(places[p].start[lane]);
      for (int i = 0; i < size; ++i) {
        to[corner] = {x[i][lane], y[i][lane]};
        if (++corner == size) corner = 0;
      }
    });
  }
};
/// What a law reads of the interfaces of a group.
struct LaneParameters {
  Pack normal_stiffness, tangential_stiffness, friction, normal_damping, tangential_damping;

  template <class Law, int corners>
  LaneParameters(const Law& law, const Interfaces& interfaces, const LaneGroup<corners>& group) {
    const bool alike = group.alike;
    alignas(64) double value[5][lanes];
    for (int lane = 0; lane < (alike ? 1 : lanes); ++lane) {
      const InterfaceParameters parameters =
          law.interface(interfaces.value + group.interface_row[lane] * interfaces.parameter_count);
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
};

}  // namespace TALUS_SIMD_LEVEL
}  // namespace talus::overlap
