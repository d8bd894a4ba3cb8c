#pragma once

#include <talus/contact_model.hpp>
#include <talus/overlap/cell_loads.hpp>
#include <talus/overlap/lane_piece.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>

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

/// Which pairs go through the lanes together, a lane each, for as long as the host's arrays stay as they are:
/// all that is kept of them, for in large scenes what is kept comes from far in every step.
struct LaneSeats {
  std::uint32_t pair[lanes];     ///< in the batch
  std::uint8_t start[2][lanes];  ///< the corner of body a and of b that is called 0
  std::uint8_t sides[2];         ///< of the pieces, as sides_of() tells; the first is the master
  bool averaged;                 ///< both roles count half
  LaneBits live;                 ///< lanes that stand for a pair
  LaneBits unseen;               ///< nobody has looked in this step whether the pieces overlap

  /// Fills all lanes, those beyond the `count`-th pair with the first.
  void take(const ContactBatch& batch, const TouchingPair* touching, int count) {
    averaged = touching[0].averaged(batch);
    unseen = 0;
    std::uint32_t corners[2][lanes];
    for (int lane = 0; lane < lanes; ++lane) {
      const TouchingPair& at = touching[lane < count ? lane : 0];
      place(at, lane);
      for (int piece = 0; piece < 2; ++piece) corners[piece][lane] = corners_of(batch.pairs[at.pair], piece);
    }
    for (int piece = 0; piece < 2; ++piece)
      sides[piece] = static_cast<std::uint8_t>(sides_of(corners[piece]));
    live = (1u << count) - 1;
  }

  /// Puts a pair into a lane that stands for none, if it is of the shape of the others.
  bool take_in(const ContactBatch& batch, const TouchingPair& touching) {
    if (live == all_lanes || touching.averaged(batch) != averaged) return false;
    for (int piece = 0; piece < 2; ++piece) {
      if (sides[piece] != mixed && corners_of(batch.pairs[touching.pair], piece) != sides[piece])
        return false;
    }
    const int lane = std::countr_one(live);
    place(touching, lane);
    live |= 1u << lane;
    return true;
  }

  /// Where the corners are is looked up in the pairs, so that a group would wait for one and then the other.
  void fetch_ahead(const ContactBatch& batch) const {
    for (const std::uint32_t number : pair) __builtin_prefetch(batch.pairs + number);
  }

 private:
  static std::uint32_t corners_of(const BodyPair& pair, int piece) {
    return pair.plain_corners[pair.master_halves == 0 ? 1 - piece : piece];
  }

  void place(const TouchingPair& touching, int lane) {
    pair[lane] = touching.pair;
    for (int body = 0; body < 2; ++body) start[body][lane] = static_cast<std::uint8_t>(touching.start(body));
    unseen = (unseen & ~(1u << lane)) | (touching.unseen() ? 1u : 0u) << lane;
  }
};

/// The pairs of a group, with all that the lanes read of them. Piece 0 is the master, where only one is.
template <int corners>
struct LaneGroup {
  LaneBits live;        ///< lanes that stand for a pair
  LaneBits remembered;  ///< in contact a step ago
  LaneBits swapped;     ///< piece 0 is that of body b
  bool averaged;        ///< both roles count half
  bool alike;           ///< all have one interface
  int sides[2];         ///< sides_of()
  LanePlaces places[2];
  std::uint32_t pair[lanes];       ///< in the batch
  Numbers slot;                    ///< of its contact
  Numbers interface_row;           ///< Interfaces::row
  Packs2 offset_of_b;              ///< m, of the piece of body b
  Pack reduced_mass, clear_depth;  ///< kg/m, m
  Pack starts;                     ///< code without pattern, as TouchingPair::remembered() reads it

  static_assert(sizeof(BodyPair) == 8 * sizeof(double) && offsetof(BodyPair, offset_x) == 8 &&
                offsetof(BodyPair, reduced_mass) == 24 && offsetof(BodyPair, clear_depth) == 28 &&
                offsetof(BodyPair, slot_start) == 32 && offsetof(BodyPair, contact_count) == 40 &&
                offsetof(BodyPair, plain_corners) == 44 && offsetof(BodyPair, master_halves) == 46 &&
                offsetof(BodyPair, corner_start) == 48 && offsetof(BodyPair, load_start) == 56 &&
                offsetof(BodyPair, interface_row) == 60);
  /// Looks up the pairs, a row of eight doubles each.
  void open(const ContactBatch& batch, const LaneSeats& seats) {
    live = seats.live;
    averaged = seats.averaged;
    for (int piece = 0; piece < 2; ++piece) sides[piece] = seats.sides[piece];
    const double* from[lanes];
    for (int lane = 0; lane < lanes; ++lane) {
      pair[lane] = seats.pair[lane];
      from[lane] = reinterpret_cast<const double*>(batch.pairs + pair[lane]);
    }
    Pack column[8];
    simd::gather_rows(from, column);
    simd::gather_rows(from, column + 4, 4);
    offset_of_b = {column[1], column[2]};
    Numbers low, high, capacity, shape;
    simd::split(column[3], low, high);
    reduced_mass = simd::floats(low);
    clear_depth = simd::floats(high);
    simd::split(column[4], slot, capacity);
    simd::split(column[5], low, shape);
    remembered = simd::bits(simd::doubles(low) > 0.0);
    const Numbers halves = shape >> 16, count[2] = {shape & 0xFF, shape >> 8 & 0xFF};
    swapped = simd::bits(simd::doubles(halves) <= 0.0);
    Numbers first[2], load[2];
    simd::split(column[6], first[0], first[1]);
    simd::split(column[7], load[0], interface_row);
    // Of a pair of bodies that are one piece each, the first has its loads before those of the second.
    load[1] = load[0] + count[0];
    Numbers start[2];
    for (int body = 0; body < 2; ++body) start[body] = simd::numbers(seats.start[body]);
    starts = simd::doubles(1 + start[0] + 8 * start[1]);
    for (int piece = 0; piece < 2; ++piece) {
      const auto of = [&](const Numbers* body) { return halves == 0 ? body[1 - piece] : body[piece]; };
      places[piece].first = of(first);
      places[piece].load_shift = of(load) - of(first);
      places[piece].start = of(start);
      places[piece].count = of(count);
    }
    alike = !simd::any(simd::doubles(interface_row ^ interface_row[0]) > 0.0);
  }

  /// m, to be added to the places of a piece.
  Packs2 offset(int piece) const {
    const Mask of_b = simd::mask_of(piece == 0 ? swapped : all_lanes & ~swapped);
    return {simd::only_where(of_b, offset_of_b.x), simd::only_where(of_b, offset_of_b.y)};
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

  void write_any(const ContactLoads& loads, int p, LaneBits wanted, const LaneCorner* from) const {
    alignas(64) double x[corners][lanes], y[corners][lanes];
    for (int i = 0; i < corners; ++i) {
      simd::store(from[i].load.x, x[i]);
      simd::store(from[i].load.y, y[i]);
    }
    each_lane(wanted, [&](int lane) {
      const auto size = static_cast<int>(places[p].count[lane]);
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
