#pragma once

#include <cstdint>

namespace talus {

/// `BoundaryCorner::surface` of a side that is no boundary: a cut along which a concave body was divided.
inline constexpr std::uint32_t internal_side = 0xFFFFFFFFu;

/// A corner of a piece and the side that starts there. One line of a cache, first what tells whether pieces
/// meet.
struct alignas(64) BoundaryCorner {
  double x, y;                  ///< m
  double tangent_x, tangent_y;  ///< unit tangent of the side; 0 for a side without length
  double vx, vy;                ///< m/s, at t_n - dt/2 (Eq. 22): x_n - x_{n-1} = v dt
  double length;                ///< m, of the side
  std::uint32_t surface;        ///< surface class of the side, or internal_side
  std::uint32_t cut;            ///< of an internal side: the number of its cut within the body
};

/// The boundaries of all bodies. A body is a set of convex *pieces* (one, if it is convex itself); a piece is
/// a counter-clockwise ring of corners; side i of a piece runs from its corner i to the next. A body of many
/// elements shows a strip along each side of its boundary instead: all that is nearest to that side, to a
/// limited depth. Loads act at real corners, the ends of sides that are not internal. Positions are
/// in the frame of the body: relative to the body's reference centre, displaced. All arrays are read-only.
struct Boundaries {
  const BoundaryCorner* corner;
  const std::uint32_t* piece_start;  ///< [piece + 1] first corner of each piece
  const std::uint8_t*
      is_strip;               ///< [piece] 1: a strip behind one side of a body of many elements, side 0 of
                              ///< the piece; the other sides are internal. Both ends of side 0 carry contact
  const double* clear_depth;  ///< [piece] m, so deep only sides that share a corner compete for a point
  /// [4 * corner] how far the boundary goes on straight past the cut at the start, and past that at the end,
  /// of the side that starts there, as a share of its length: for the piece beyond may not be listed. Then,
  /// for start and end, what an edge that lies flat on the side spans beyond that: sides turned inwards by θ
  /// < 45°, of which cos 2θ counts. 0 where there is no cut; null where no body has any.
  const double* straight_beyond;
};

/// Parameters of the interface between two surface classes, in the order the law declared them.
struct Interfaces {
  const std::uint32_t* row;  ///< [surface * surface_count + surface]
  const double* value;       ///< [row * parameter_count + parameter]
  std::uint32_t surface_count;
  std::uint32_t parameter_count;
};

/// A piece of body a and a piece of body b that are close enough to touch.
struct PiecePair {
  std::uint32_t a;
  std::uint32_t b;
  std::uint32_t load_start;  ///< first entry in ContactLoads::corner: corners of a, then corners of b
};

/// Two bodies that are close enough to touch, or twice the same one that touches itself. The frame of a pair
/// is the frame of body a. One line of a cache.
struct BodyPair {
  std::uint32_t a;
  std::uint32_t b;
  double offset_x;     ///< m, added to a position of body b gives it in the frame of body a
  double offset_y;     ///< m
  float reduced_mass;  ///< kg per metre of thickness: m_a m_b/(m_a + m_b); the mass of one if the other is
                       ///< fixed; a body of many elements counts by a patch of its boundary
  float clear_depth;   ///< m, of plain bodies: the lesser of Boundaries::clear_depth, or a little less
  std::uint32_t slot_start;     ///< first contact slot of this pair
  std::uint32_t slot_capacity;  ///< how many contacts it can hold; 0 until it has some
  std::uint32_t
      contact_count;  ///< contacts of the previous step: slots [slot_start, slot_start + contact_count)
  std::uint8_t plain_corners[2];  ///< of a and of b, where both bodies are plain: one convex piece of 255
                                  ///< corners at most, of one surface class all around; else 0
  std::uint16_t master_halves;    ///< see master_share()

  // What laws look up for every pair of plain bodies, from the arrays that hold it for all.
  union {
    std::uint32_t corner_start[2];      ///< plain: first corner of a and of b in Boundaries::corner
    std::uint32_t piece_pair_range[2];  ///< others: their piece pairs, from PiecePairs::listed[0] up to [1]
  };
  std::uint32_t load_start;     ///< plain: PiecePair::load_start of their pieces
  std::uint32_t interface_row;  ///< plain: Interfaces::row of their surfaces

  bool plain() const { return plain_corners[0] != 0; }
  std::uint32_t piece_pair_count() const { return plain() ? 1 : piece_pair_range[1] - piece_pair_range[0]; }
  /// Share of body a as master: 1 (b is slave), 0 (a is slave), 0.5 (both roles).
  double master_share() const { return 0.5 * master_halves; }
};
static_assert(sizeof(BodyPair) == 64);

/// The piece pairs of all pairs: of plain bodies the one there is follows from the bodies.
struct PiecePairs {
  const PiecePair* listed;           ///< of pairs that are not plain
  const std::uint32_t* first_piece;  ///< [body]

  PiecePair at(const BodyPair& pair, std::uint32_t i) const {
    if (pair.plain()) return {first_piece[pair.a], first_piece[pair.b], pair.load_start};
    return listed[pair.piece_pair_range[0] + i];
  }

  /// For loops over those of one pair.
  class OfPair {
   public:
    struct Iterator {
      const PiecePairs& all;
      const BodyPair& pair;
      std::uint32_t number;

      PiecePair operator*() const { return all.at(pair, number); }
      Iterator& operator++() {
        ++number;
        return *this;
      }
      bool operator!=(const Iterator& other) const { return number != other.number; }
    };

    OfPair(const PiecePairs& all, const BodyPair& pair) : all_(all), pair_(pair) {}
    Iterator begin() const { return {all_, pair_, 0}; }
    Iterator end() const { return {all_, pair_, pair_.piece_pair_count()}; }

   private:
    const PiecePairs& all_;
    const BodyPair& pair_;
  };
  OfPair of(const BodyPair& pair) const& { return {*this, pair}; }
  OfPair of(const BodyPair& pair) const&& = delete;  ///< loops would outlive it
};

/// What a law keeps of a batch of pairs from step to step, such as which of them it evaluates side by side:
/// made by ContactModel::make_plan(), held by the host with the batch, and never saved, so no result may
/// depend on it.
class BatchPlan {
 public:
  BatchPlan() = default;
  BatchPlan(const BatchPlan&) = delete;
  BatchPlan& operator=(const BatchPlan&) = delete;
  virtual ~BatchPlan() = default;
};

/// What a law is given: a range of pairs at time t_n. Host memory, read-only.
struct ContactBatch {
  Boundaries boundaries;
  Interfaces interfaces;
  const BodyPair* pairs;
  PiecePairs piece_pairs;
  const double* history;        ///< [slot * doubles_per_contact] as the law left it at t_{n-1}
  const std::uint32_t* active;  ///< [active_count] the pairs to evaluate, as indices into `pairs`, rising
  std::uint32_t active_count;
  double dt;        ///< s, from t_{n-1} to t_n; 0 at the first call of a run
  bool hold_stick;  ///< settling: friction is held stuck, no slip limit applies; with μ = 0 there is
                    ///< none, as ever
  bool bonds_form;  ///< first evaluation and settling: contacts found now are born intact
  BatchPlan* plan = nullptr;  ///< of this batch, for the law to change; or none
  /// While it is the same, so is all of `pairs` and `piece_pairs` but contact_count, and the slots of pairs
  /// that had none.
  std::uint64_t layout = 0;
};

/// Corners of a plain body, at most.
inline constexpr std::uint32_t most_plain_corners = 255;

/// Says of a pair of plain bodies, each of one of two pieces, what BodyPair repeats.
inline void describe_plain(BodyPair& pair, std::uint32_t piece_a, std::uint32_t piece_b,
                           const Boundaries& boundaries, std::uint32_t interface_row) {
  const std::uint32_t piece[2] = {piece_a, piece_b};
  for (int i = 0; i < 2; ++i) {
    const std::uint32_t start = boundaries.piece_start[piece[i]];
    pair.corner_start[i] = start;
    pair.plain_corners[i] = static_cast<std::uint8_t>(boundaries.piece_start[piece[i] + 1] - start);
  }
  pair.interface_row = interface_row;
  const double depth_a = boundaries.clear_depth[piece_a], depth_b = boundaries.clear_depth[piece_b];
  constexpr double below = 1 - 1e-7;  // whichever way it is rounded
  pair.clear_depth = static_cast<float>(below * (depth_a < depth_b ? depth_a : depth_b));
}

/// One contact, for pictures, monitors and diagnosis. In the frame of the pair.
struct ContactReport {
  double x, y;         ///< m, a place amid it that its loads are told about
  double px, py;       ///< N/m, normal force on body b
  double tx, ty;       ///< N/m, tangential force on body b
  double penetration;  ///< m, the largest
  double slipping;     ///< 1 while it slips, 0 while it sticks
  double moment;       ///< N, of all that acts on body b, about x, y: 0 where the resultant acts there
};

/// Per pair, for the energy ledger and the guards.
struct PairReport {
  std::uint32_t
      contact_count;    ///< contacts found; if more than slot_capacity the host makes room and asks again
  float damping_force;  ///< N/m, of all dashpots, by size, also where nothing has moved yet; 0 where none
                        ///< pushes
  double penetration;   ///< m, the largest overlap depth of the pair
  double stored;        ///< J/m, recoverable energy, 0 or more: normal and tangential springs
  double slip_loss;  ///< J/m, dissipated by friction since t_{n-1} (also energy dropped by a law's resets);
                     ///< never negative
  double damping_power;  ///< J/m, damping force of t_n times displacement since t_{n-1}; never negative
  double gap;  ///< m, 0, or of a pair without contact: the bodies are at least so far apart, and the law need
               ///< not be asked again until they may have come so much closer
};

/// What acts on a corner, N/m.
struct CornerLoad {
  double x, y;
};

/// What a law fills in, in host memory sized by the host. Nothing is zero before the call: the law writes the
/// report of every active pair, and of a pair with contacts the loads of all its corners and the slots it
/// counts. It writes only at indices of the pairs it was given.
struct ContactLoads {
  CornerLoad* corner;      ///< [load] PiecePair::load_start + position of the corner in the piece
  double* history;         ///< [slot * doubles_per_contact] of t_n; separate from ContactBatch::history
  ContactReport* reports;  ///< [slot], or nullptr where nobody wants to see them
  PairReport* pairs;       ///< like ContactBatch::pairs
};

/// Springs a stretch of boundary can meet, for the time step.
struct ContactStiffness {
  double normal;  ///< N/m per metre of thickness, upper bound
  double tangential;
  double normal_damping_ratio;  ///< of critical, with the reduced mass
  double tangential_damping_ratio;
};

/// A contact law. Const: all state lives in the host's history. Implementations are made by the plugin's
/// `create` and must be callable from several threads at once with disjoint ranges of pairs.
class ContactModel {
 public:
  virtual ~ContactModel() = default;

  /// How many doubles of history the host keeps for each contact, 4,096 at most. Those of a pair are the
  /// first `contact_count` of its slots; the rest are remains. Numbers of bodies, pieces and corners stay
  /// what they are for a whole run and its continuation, so a law may know a contact again by them.
  virtual std::uint32_t doubles_per_contact() const noexcept = 0;

  /// Turns the declared parameters of one interface, once, into what the step wants in their places (the
  /// tangent of an angle, say). `evaluate` and `stiffness` get the prepared values.
  virtual void prepare_interface(double* values) const noexcept { (void)values; }

  /// A new plan, for a batch that it has not seen yet; the host deletes it. Null if there is nothing to keep.
  virtual BatchPlan* make_plan() const noexcept { return nullptr; }

  /// Loads at t_n (Eqs. 28–44). Equal and opposite, without net moment, at the corners of the pieces.
  virtual void evaluate(const ContactBatch& batch, const ContactLoads& loads) const noexcept = 0;

  /// Bound of the springs on `length` metres of a body's side under prepared interface parameters (declared
  /// order), as lumped at one corner at the end of a side of twice that length.
  virtual ContactStiffness stiffness(const double* values, double length) const noexcept = 0;
};

}  // namespace talus
