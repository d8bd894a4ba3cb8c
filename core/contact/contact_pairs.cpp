#include "contact/contact_stage.hpp"
#include "contact/room.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace talus {
namespace {

/// Share of the mean width by which boxes are grown with the skin off: laws see a little further than bodies
/// overlap, vertex_edge a hundredth of an edge.
constexpr double sight = 0.02;
/// Share of the mean width by which pieces may come nearer until their list is sifted again.
constexpr double until_sifted = 0.01;

constexpr std::size_t pieces_at_once = 64;

/// Whether MotionState::shape_piece() has to be called for its pieces: a body of one piece is shaped as it
/// moves.
bool shaped_by_piece(const Model& model, std::uint32_t body) {
  return model.moves(body) && !model.one_piece(model.bodies[body]);
}

}  // namespace

bool ContactStage::find_pairs(const Model& model, MotionState& motion, double dt,
                              const MotionState::Speeds& speeds) {
  if (!law_) return false;
  // Both bodies of a pair may have moved; the boxes leave half of what is near to each.
  slack_ -= dt * speeds.closing();
  way_.time += dt;
  way_.strayed += 2 * dt * speeds.stray;
  way_.travelled += 2 * dt * speeds.closing();
  const bool due = !(slack_ > 0), every_step = !(skin_ > 0);
  sifted_slack_ -= dt * speeds.closing();
  if (!due && !every_step) {
    if (sifts_ && !(sifted_slack_ > 0)) {
      shape_all(model, motion);
      sift_pieces(model, motion);
      list_to_shape(model);
      share_anew(model);
    } else {
      shape_listed(model, motion);
    }
    if (workers_.threads() > 1 && std::has_single_bit(++steps_shared_) &&
        worth_dividing_anew(pairs_, sharing_, workers_.threads(), batch_begin_, other_batches_))
      share_anew(model);
    drift_on(model, motion);
    return false;
  }
  shape_all(model, motion);
  if (due) {
    search_.find(model, motion, near_, candidates_);
    keep_touching(model);
    note_neighbours(model);
    slack_ = near_ / 2;
    take_drift(model, motion);
  }
  if (every_step) {
    search_.find(model, motion, sight * model.mean_width, candidates_);
    keep_touching(model);
  }
  rebuild_pairs(model, motion);
  ++searches_;
  return due;
}

/// Where a search looks.
void ContactStage::shape_all(const Model& model, MotionState& motion) {
  for (const std::uint32_t b : model.moving_bodies) {
    const Body& body = model.bodies[b];
    if (!shaped_by_piece(model, b)) continue;
    workers_.over(body.piece_end - body.piece_begin, pieces_at_once,
                  [&](std::size_t, std::size_t begin, std::size_t end) {
                    for (std::size_t i = begin; i < end; ++i)
                      motion.shape_piece(model, static_cast<std::uint32_t>(body.piece_begin + i));
                  });
  }
}

/// Where a law looks until the next search.
void ContactStage::shape_listed(const Model& model, MotionState& motion) {
  workers_.over(to_shape_.size(), pieces_at_once, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) motion.shape_piece(model, to_shape_[i]);
  });
}

void ContactStage::list_to_shape(const Model& model) {
  to_shape_.clear();
  const PiecePairs all = piece_pairs();
  for (const BodyPair& pair : pairs_) {
    if (plain(pair.a, pair.b)) continue;
    for (const PiecePair pieces : all.of(pair)) {
      for (const std::uint32_t piece : {pieces.a, pieces.b}) {
        if (shaped_by_piece(model, model.piece_body[piece])) append_to(to_shape_, piece);
      }
    }
  }
  std::sort(to_shape_.begin(), to_shape_.end());
  to_shape_.erase(std::unique(to_shape_.begin(), to_shape_.end()), to_shape_.end());
}

/// A bond may span any gap: two bodies in contact stay a pair, however far apart they are. As long as pieces
/// of them are near, those are their contact.
void ContactStage::keep_touching(const Model& model) {
  const auto bodies_of = [&](const Candidate& candidate) {
    return std::pair{model.piece_body[candidate.piece_a], model.piece_body[candidate.piece_b]};
  };
  const std::size_t found = candidates_.size();
  const PiecePairs all = piece_pairs();
  std::size_t k = 0;
  for (const BodyPair& pair : pairs_) {
    if (pair.contact_count == 0) continue;
    const std::pair wanted{pair.a, pair.b};
    while (k < found && bodies_of(candidates_[k]) < wanted) ++k;
    if (k < found && bodies_of(candidates_[k]) == wanted) continue;
    for (const PiecePair pieces : all.of(pair)) append_to(candidates_, {pieces.a, pieces.b});
  }
  const auto first = candidates_.begin();
  std::inplace_merge(first, first + static_cast<std::ptrdiff_t>(found), candidates_.end(),
                     CandidateOrder(model));
}

void ContactStage::note_neighbours(const Model& model) {
  lightest_neighbour_.assign(model.bodies.size(), std::numeric_limits<double>::infinity());
  heaviest_neighbour_.assign(holds_any() ? model.bodies.size() : 0, 0.0);
  const auto note = [&](std::uint32_t own, std::uint32_t other) {
    const Body& body = model.bodies[other];
    // What is held by its centre has strain modes all the same.
    if (!held_[other] || body.kinematics != Kinematics::rigid)
      lightest_neighbour_[own] = std::min(lightest_neighbour_[own], body.contact_mass);
    if (held_[own] && !held_[other])
      heaviest_neighbour_[own] = std::max(heaviest_neighbour_[own], body.contact_mass);
  };
  for (const Candidate& candidate : candidates_) {
    const std::uint32_t a = model.piece_body[candidate.piece_a], b = model.piece_body[candidate.piece_b];
    if (fixed_[a] != 0 || fixed_[b] != 0) continue;
    note(a, b);
    note(b, a);
  }
}

void ContactStage::rebuild_pairs(const Model& model, const MotionState& motion) {
  slots_.close_up(pairs_, batch_begin_);
  keep_former_pairs();
  pair_up_candidates(model);
  describe_plain_pairs(model);
  ask_again_.assign(pairs_.size(), 0);
  approach_.assign(pairs_.size(), 0);
  give_back_slots();
  if (sifts_) sift_pieces(model, motion);
  list_to_shape(model);
  lay_out_loads(model);
  lay_out_slots();
  if (!island_.empty()) hold_sleeping_pairs();
}

void ContactStage::keep_former_pairs() {
  const auto touches = [](const BodyPair& pair) { return pair.contact_count > 0; };
  former_pairs_.clear();
  make_room_in(former_pairs_, static_cast<std::size_t>(std::count_if(pairs_.begin(), pairs_.end(), touches)));
  for (const BodyPair& pair : pairs_) {
    if (!touches(pair)) continue;
    former_pairs_.push_back({pair.a, pair.b, pair.slot_start, pair.slot_capacity, pair.contact_count});
  }
}

/// Pairs of bodies from those of pieces that are near each other, sorted by bodies.
void ContactStage::pair_up_candidates(const Model& model) {
  pairs_.clear();
  piece_pairs_.clear();
  steps_shared_ = 0;
  const auto same_bodies = [&](const Candidate& p, const Candidate& q) {
    return model.piece_body[p.piece_a] == model.piece_body[q.piece_a] &&
           model.piece_body[p.piece_b] == model.piece_body[q.piece_b];
  };
  std::size_t repeated = 0, listed = 0;
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    repeated += i > 0 && same_bodies(candidates_[i - 1], candidates_[i]) ? 1 : 0;
    const auto& [piece_a, piece_b] = candidates_[i];
    listed += plain(model.piece_body[piece_a], model.piece_body[piece_b]) ? 0 : 1;
  }
  make_room_in(pairs_, candidates_.size() - repeated);
  make_room_in(piece_pairs_, listed);
  for (const auto& [piece_a, piece_b] : candidates_) {
    const std::uint32_t of_a = model.piece_body[piece_a], of_b = model.piece_body[piece_b];
    if (pairs_.empty() || pairs_.back().a != of_a || pairs_.back().b != of_b)
      pairs_.push_back(new_pair(model, of_a, of_b));
    if (plain(of_a, of_b)) continue;
    piece_pairs_.push_back({piece_a, piece_b, 0});
    pairs_.back().piece_pair_range[1] = static_cast<std::uint32_t>(piece_pairs_.size());
  }
}

/// One whose pieces, if they are listed, come next.
BodyPair ContactStage::new_pair(const Model& model, std::uint32_t of_a, std::uint32_t of_b) const {
  const Body &a = model.bodies[of_a], &b = model.bodies[of_b];
  BodyPair pair{};
  pair.a = of_a, pair.b = of_b;
  pair.master_halves = master_halves(of_a, of_b);
  pair.offset_x = b.centre.x - a.centre.x, pair.offset_y = b.centre.y - a.centre.y;
  pair.reduced_mass = reduced_mass(model, of_a, of_b);
  pair.piece_pair_range[0] = static_cast<std::uint32_t>(piece_pairs_.size());
  return pair;
}

/// History goes with its pair: both lists are sorted by bodies.
void ContactStage::give_back_slots() {
  const auto bodies = [](const auto& of) { return std::pair{of.a, of.b}; };
  auto former = former_pairs_.cbegin();
  for (BodyPair& pair : pairs_) {
    while (former != former_pairs_.cend() && bodies(*former) < bodies(pair)) ++former;
    if (former == former_pairs_.cend()) break;
    if (bodies(*former) != bodies(pair)) continue;
    pair.slot_start = former->slot_start;
    pair.slot_capacity = former->slot_capacity;
    pair.contact_count = former->contact_count;
  }
}

/// Along a joint between two bodies of many elements a search, which serves for long, finds each side of the
/// one near several of the other. Those that can meet before the list is sifted again come first, in their
/// order, and laws see them alone; of a pair without any one stays, or all while it is in contact.
void ContactStage::sift_pieces(const Model& model, const MotionState& motion) {
  const double width = model.mean_width, margin = (sight + until_sifted) * width;
  sifted_slack_ = until_sifted * width / 2;
  auto end = static_cast<std::uint32_t>(piece_pairs_.size());
  for (std::size_t i = pairs_.size(); i-- > 0;) {
    BodyPair& pair = pairs_[i];
    if (plain(pair.a, pair.b)) continue;
    auto& [first, last] = pair.piece_pair_range;
    const std::span<PiecePair> all = std::span(piece_pairs_).subspan(first, end - first);
    std::ranges::sort(all, {}, [](const PiecePair& pieces) { return std::pair{pieces.a, pieces.b}; });
    std::uint32_t near = 0;
    for (PiecePair& pieces : all) {
      const bool apart = outside_of_a_side(model, motion, pieces.a, pieces.b, margin) ||
                         outside_of_a_side(model, motion, pieces.b, pieces.a, margin);
      if (!apart) std::swap(pieces, all[near++]);
    }
    const std::uint32_t least = pair.contact_count > 0 ? end - first : 1;
    last = first + (near > 0 ? near : least);
    end = first;
    // How far apart a pair is was told of those that laws saw. One that sleeps is not asked about at all.
    if (std::isfinite(ask_again_[i])) ask_again_[i] = 0;
  }
}

/// By the contacts found since the search: in the first steps of a scene none is known.
void ContactStage::share_anew(const Model& model) {
  slots_.close_up(pairs_, batch_begin_);
  lay_out_loads(model);
  lay_out_slots();
}

/// Of the pairs there are.
void ContactStage::lay_out_loads(const Model& model) {
  divide_into_batches(pairs_, sharing_, workers_.threads(), batch_begin_);
  loads_.lay_out(model, pairs_, batch_begin_, piece_pairs_, first_piece_);
  if (keeps_stored_) stored_.resize(pairs_.size());
  chunk_totals_.resize((pairs_.size() + sharing_.chunk - 1) / sharing_.chunk);
  // Between searches nobody asks for memory: batches are whole chunks.
  if (workers_.threads() > 1) make_room_in(other_batches_, chunk_totals_.size() + 1);
}

void ContactStage::describe_plain_pairs(const Model& model) {
  const Boundaries boundaries{nullptr, model.piece_start.data(), nullptr, clear_depth_.data(), nullptr};
  for (BodyPair& pair : pairs_) {
    pair.plain_corners[0] = pair.plain_corners[1] = 0;
    if (!plain(pair.a, pair.b)) continue;
    describe_plain(
        pair, first_piece_[pair.a], first_piece_[pair.b], boundaries,
        interfaces_
            .row[std::size_t{plain_surface_[pair.a]} * interfaces_.surface_count + plain_surface_[pair.b]]);
  }
}

}  // namespace talus
