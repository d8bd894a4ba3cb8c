#pragma once

#include "archive/archive.hpp"
#include "contact/contact_slots.hpp"
#include "contact/law_fault.hpp"
#include "contact/neighbours.hpp"
#include "contact/room.hpp"
#include "contact/wave_loads.hpp"
#include "kernels/blocks.hpp"
#include "kernels/contact_totals.hpp"
#include "kernels/contacts.hpp"
#include "model/model.hpp"
#include "model/motion.hpp"
#include "parallel/workers.hpp"
#include "plugin/registry.hpp"
#include "scene/scene.hpp"

#include <talus/contact_model.hpp>

#include <algorithm>
#include <span>
#include <vector>

namespace talus {

/// Which bodies may touch, the law's history of each contact, and the forces of a step (Table 1).
class ContactStage {
 public:
  /// `seen`: whether anybody will look at reports_of(); else there are none.
  ContactStage(const Scene& scene, const Model& model, Workers& workers, bool neighbour_skin,
               SimdLevel level = SimdLevel::scalar, bool seen = true);

  const ContactModel* law() const { return law_.get(); }
  const Interfaces& interfaces() const { return interfaces_; }

  /// Other parameters from now on, as [row][parameter] of the scene's interfaces. True when springs along an
  /// interface that had some and still has are of another stiffness.
  bool set_interfaces(const std::vector<std::vector<double>>& values);

  /// From now on: a body that moves as a whole and is held or driven in all of that meets others as a fixed
  /// one does, whatever its mass.
  void set_supports(const Model& model, std::span<const Support> supports);

  /// Seeks the candidates anew when something may have moved through the skin since the last search. The last
  /// call was `dt` ago, s, and bodies have moved at `speeds` since. True when who is near whom was found
  /// anew: at the same times whether a skin is used or not. Pieces that pairs list are shaped (see
  /// MotionState), others only for a search.
  bool find_pairs(const Model& model, MotionState& motion, double dt, const MotionState::Speeds& speeds);

  /// [corner] the velocity with which it is taken to go on for a while. Neighbours that move along with
  /// each other close no gap by that, however fast they are.
  std::span<const kernels::CornerDrift> drift() const { return corner_drift_; }

  /// [body] kg per metre of thickness, the lightest moving one near it; infinite if there is none.
  std::span<const double> lightest_neighbours() const { return lightest_neighbour_; }
  /// Of one that is held: the heaviest that is not; 0 if there is none. Empty where none is held.
  std::span<const double> heaviest_neighbours() const { return heaviest_neighbour_; }

  struct Conditions {
    double dt;  ///< s, from t_{n-1} to t_n
    bool hold_stick, bonds_form;
    bool observed = true;  ///< whether anybody may look at what is found
  };
  /// Evaluates the law on all pairs and adds the loads to the forces on the moving bodies.
  ContactTotals evaluate(const Model& model, MotionState& motion, const Conditions& conditions);

  /// What the law did in the last evaluate() that no law may do: sought where it was observed or gave what is
  /// no number, for that costs as much as a look at all loads.
  const LawFault& fault() const { return fault_; }

  /// Between steps. The law's history goes as it is, whoever's law it is.
  void exchange(Archive& archive, const Model& model);

  /// [body] the island that it sleeps in, 0 for none; empty: all are awake. Contacts within an island stay as
  /// they are from the next step on. The array is looked at until the next call.
  void set_asleep(std::span<const std::uint32_t> island);
  /// Islands that other bodies were found to touch by the last evaluate(), rising; it took them as awake.
  const std::vector<std::uint32_t>& touched() const { return touched_; }
  /// What a pair evaluated last holds, J/m; of scenes with sleep.
  double stored_in(std::size_t pair) const { return stored_[pair]; }

  std::uint64_t searches() const { return searches_; }
  std::span<const BodyPair> pairs() const { return pairs_; }
  PiecePairs piece_pairs() const { return {piece_pairs_.data(), first_piece_.data()}; }
  /// [contact] of a pair, of a step that was observed.
  std::span<const ContactReport> reports_of(std::size_t pair) const {
    if (!slots_.keeps_reports()) return {};
    return {slots_.reports(slot_of(pair)), pairs_[pair].contact_count};
  }
  /// [contact * doubles_per_contact] of a pair.
  std::span<const double> history_of(std::size_t pair) const {
    return {slots_.history(slot_of(pair)), std::size_t{pairs_[pair].contact_count} * slots_.doubles()};
  }

 private:
  static constexpr std::uint32_t no_pair = 0xFFFFFFFFu;
  static constexpr float in_this_step = -1;  ///< of ask_again_: less than any way
  static constexpr kernels::Way no_way{0, in_this_step, in_this_step};

  void refuse_unsound_interfaces(const RegisteredComponent& law) const;
  void keep_touching(const Model& model);
  void note_neighbours(const Model& model);
  bool holds_any() const { return std::ranges::find(held_, 1) != held_.end(); }
  float reduced_mass(const Model& model, std::uint32_t a, std::uint32_t b) const;
  void shape_all(const Model& model, MotionState& motion);
  void shape_listed(const Model& model, MotionState& motion);
  void list_to_shape(const Model& model);
  void rebuild_pairs(const Model& model, const MotionState& motion);
  void keep_former_pairs();
  void pair_up_candidates(const Model& model);
  BodyPair new_pair(const Model& model, std::uint32_t of_a, std::uint32_t of_b) const;
  void give_back_slots();
  void take_drift(const Model& model, const MotionState& motion);
  kernels::Drift drift_of(const Model& model, const Body& body, const MotionState& motion);
  void drift_on(const Model& model, const MotionState& motion);
  void share_anew(const Model& model);
  void sift_pieces(const Model& model, const MotionState& motion);
  void lay_out_loads(const Model& model);
  void describe_plain_pairs(const Model& model);
  bool plain(std::uint32_t a, std::uint32_t b) const {
    return plain_surface_[a] != internal_side && plain_surface_[b] != internal_side;
  }
  bool fits(const Model& model) const;
  void lay_out_slots();
  void size_workspaces();
  std::size_t batch_of(std::size_t pair) const {
    return static_cast<std::size_t>(std::upper_bound(batch_begin_.begin(), batch_begin_.end(), pair) -
                                    batch_begin_.begin()) -
           1;
  }
  std::size_t slot_of(std::size_t pair) const {
    return slots_.first_of(batch_of(pair)) + pairs_[pair].slot_start;
  }
  /// A pair with more contacts than slots.
  struct ShortOfRoom {
    std::uint32_t pair, contacts;
  };
  /// What a law says of a batch of pairs.
  struct Workspace {
    std::vector<std::uint32_t> active;
    std::vector<PairReport> reports;
    InLines<double> history;                 ///< of the slots of the batch
    std::vector<ShortOfRoom> short_of_room;  ///< until some_short_of_room() takes them
  };
  struct ChunkTotals : ContactTotals {
    std::uint32_t unsound = no_pair;  ///< a pair with a report that is no number
  };
  /// Part of the pairs: those whose loads are held at once.
  struct Wave {
    std::size_t number, begin, end;
    std::size_t first_chunk, end_chunk;  ///< in chunk_totals_
  };
  Wave wave(std::size_t number) const {
    const std::size_t size = pairs_of_wave(workers_.threads()), begin = number * size,
                      end = std::min(begin + size, pairs_.size());
    return {number, begin, end, begin / sharing_.chunk, (end + sharing_.chunk - 1) / sharing_.chunk};
  }
  void evaluate(const Model& model, MotionState& motion, const Conditions& conditions,
                const kernels::Way& gone);
  template <class Each>
  void ask(const Model& model, const MotionState& motion, const Conditions& conditions, const Wave& wave,
           const kernels::Way& gone, const Each& each);
  template <class Each>
  void ask_again(const Model& model, const MotionState& motion, const Conditions& conditions,
                 const Each& each);
  template <class Each>
  void ask_about(const Model& model, const MotionState& motion, const Conditions& conditions,
                 std::size_t batch, std::uint32_t count, bool all, Workspace& found, const Each& each);
  void fetch_ahead(const MotionState& motion, std::size_t begin, std::size_t slot,
                   std::span<const std::uint32_t> active) const;
  void close(const Model& model, std::size_t batch, std::span<const std::uint32_t> active, Workspace& found);
  static void note_short_of_room(std::size_t pair, std::uint32_t in_batch, Workspace& found) {
    append_to(found.short_of_room, {static_cast<std::uint32_t>(pair), found.reports[in_batch].contact_count});
  }
  bool some_short_of_room();
  void make_room();
  static std::uint32_t first_unsound(std::size_t begin, std::span<const std::uint32_t> active,
                                     const Workspace& found);
  ContactTotals totals() const;
  void bound_capacities();
  template <class Is>
  bool any_chunk(const Wave& wave, const Is& is) const {
    return std::any_of(chunk_totals_.begin() + static_cast<std::ptrdiff_t>(wave.first_chunk),
                       chunk_totals_.begin() + static_cast<std::ptrdiff_t>(wave.end_chunk), is);
  }
  LawFault runaway() const;
  LawFault fault_of(const Model& model, const MotionState& motion, const Wave& wave) const;
  double stiffest_interface() const;
  bool sleeps(const BodyPair& pair) const;
  void hold_sleeping_pairs();
  bool wake_touched();
  std::uint16_t master_halves(std::uint32_t a, std::uint32_t b) const;

  std::unique_ptr<ContactModel, void (*)(void*) noexcept> law_;
  std::vector<double> interface_values_;
  Interfaces interfaces_{};
  std::vector<double> priority_;  ///< [body], empty with symmetric roles
  std::vector<char> fixed_;       ///< [body]
  std::vector<char> held_;        ///< [body] whether others meet it as a fixed one
  /// [body] the surface class of one that is plain as BodyPair says it, or internal_side.
  std::vector<std::uint32_t> plain_surface_;
  std::vector<std::uint32_t> first_piece_;  ///< [body] as PiecePairs says it
  std::vector<double> clear_depth_;         ///< [piece] as Boundaries::clear_depth
  std::vector<double> straight_beyond_;     ///< [4 * corner] as Boundaries::straight_beyond; may be empty
  Workers& workers_;
  const kernels::ContactKernels& kernels_;
  PairSharing sharing_;
  double near_;              ///< m, up to which bodies are neighbours
  double skin_;              ///< m, the same, or 0 where pairs are sought anew in every step
  double slack_ = -1;        ///< m left before neighbours are sought again; negative: at once
  bool sifts_;               ///< whether sift_pieces() is worth its while
  double sifted_slack_ = 0;  ///< m left before it is called again
  std::uint64_t searches_ = 0;

  std::vector<Workspace> workspaces_;  ///< [thread]
  bool keeps_stored_;

  NeighbourSearch search_;
  std::vector<Candidate> candidates_;
  std::vector<double> lightest_neighbour_, heaviest_neighbour_;  ///< [body] kg per metre of thickness
  InLines<BodyPair> pairs_;
  /// What goes with a pair in contact from one search to the next.
  struct FormerPair {
    std::uint32_t a, b, slot_start, slot_capacity, contact_count;
  };
  std::vector<FormerPair> former_pairs_;
  std::vector<PiecePair> piece_pairs_;         ///< PiecePairs::listed, and behind those of a pair what is far
  std::vector<std::uint32_t> to_shape_;        ///< pieces, of those that do not move whole with their bodies
  std::vector<std::uint32_t> batch_begin_{0};  ///< [batch + 1] pairs
  /// [batch, at least; or empty] what the law keeps of it; not where only some pairs are asked about again
  std::vector<std::unique_ptr<BatchPlan>> plans_;
  std::uint64_t layout_ = 0;                  ///< how often pairs or their slots were laid out
  std::vector<std::uint32_t> other_batches_;  ///< those of another division, while the two are compared
  std::uint64_t steps_shared_ = 0;            ///< since the last search
  WaveLoads loads_;
  LawFault fault_;
  std::vector<ChunkTotals> chunk_totals_;
  std::vector<kernels::CornerDrift> corner_drift_;  ///< see drift()
  std::vector<kernels::Drift> drift_;               ///< [body] of its corners
  kernels::Way way_;                                ///< since the drift was taken
  std::uint32_t steps_adrift_ = 0;
  /// [pair] m of way_, when a law is to be asked about it, and at what speed its bodies drift, m/s.
  std::vector<float> ask_again_, approach_;
  std::vector<double> stored_;  ///< [pair] J/m, if keeps_stored_
  ContactSlots slots_;
  std::vector<ShortOfRoom> short_of_room_;       ///< pairs of the wave that was asked about last, rising
  std::vector<std::uint32_t> wanted_;            ///< [batch] slots, by those pairs
  std::vector<std::uint32_t> island_, touched_;  ///< see set_asleep() and touched()
  std::vector<std::uint32_t> border_;            ///< pairs of a body that sleeps with one that is awake
  std::vector<char> still_;  ///< [body] it sleeps, and nobody who is awake may touch it; empty: none does
};

}  // namespace talus
