#include "contact/contact_stage.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace talus {
void ContactStage::exchange(Archive& archive, const Model& model) {
  if (!law_) return;
  archive(slack_);
  archive(sifted_slack_);
  archive(way_);
  archive.of_known_size(corner_drift_);
  archive.of_known_size(drift_);
  archive(searches_);
  archive.of_known_size(lightest_neighbour_);
  archive(heaviest_neighbour_);
  slots_.close_up(pairs_, batch_begin_);
  archive(pairs_);
  archive(piece_pairs_);
  archive(ask_again_);
  archive(approach_);
  slots_.exchange(archive);
  archive(island_);
  if (archive.reading()) {
    if (!fits(model)) Archive::refuse();
    slots_.fit_reports(pairs_.empty() ? 0 : pairs_.back().slot_start + pairs_.back().contact_count);
    list_to_shape(model);
    describe_plain_pairs(model);
    bound_capacities();
    lay_out_loads(model);
  }
  lay_out_slots();
  if (archive.reading() && !island_.empty()) hold_sleeping_pairs();
}

/// A pair that is asked about once more, for want of slots, adds to sums after others: capacities go on as
/// they are. But no damaged state may ask for more than it could hold.
void ContactStage::bound_capacities() {
  constexpr std::size_t most_for_pieces = 32;
  std::size_t asked = 0;
  for (const BodyPair& pair : pairs_) asked += pair.slot_capacity;
  const bool sound = asked <= most_for_pieces * (pairs_.size() + piece_pairs_.size());
  for (BodyPair& pair : pairs_) {
    if (!sound || pair.slot_capacity < pair.contact_count) pair.slot_capacity = pair.contact_count;
  }
}

/// Whether all indices lead into the arrays of this scene, and pairs are what a search makes of them: those
/// in contact are found again by their bodies and pieces.
bool ContactStage::fits(const Model& model) const {
  const std::size_t pairs = pairs_.size();
  if (ask_again_.size() != pairs || approach_.size() != pairs) return false;
  const auto of_bodies = [&](const auto& values) {
    return values.empty() || values.size() == model.bodies.size();
  };
  if (!of_bodies(island_) || !of_bodies(heaviest_neighbour_)) return false;
  for (const PiecePair& pieces : piece_pairs_) {
    if (pieces.a >= model.piece_body.size() || pieces.b >= model.piece_body.size()) return false;
  }
  const auto bodies = [](const BodyPair& pair) { return std::pair{pair.a, pair.b}; };
  if (std::ranges::adjacent_find(pairs_, std::greater_equal{}, bodies) != pairs_.end()) return false;
  std::size_t contacts = 0;
  for (const BodyPair& pair : pairs_) {
    if (pair.slot_start != contacts) return false;
    contacts += pair.contact_count;
    if (pair.a >= model.bodies.size() || pair.b >= model.bodies.size()) return false;
  }
  std::size_t listed_end = piece_pairs_.size();
  for (std::size_t i = pairs; i-- > 0;) {
    const BodyPair& pair = pairs_[i];
    if (plain(pair.a, pair.b)) continue;
    const auto [begin, end] = pair.piece_pair_range;
    if (begin >= end || end > listed_end) return false;
    const auto of_others = [&](const PiecePair& pieces) {
      return model.piece_body[pieces.a] != pair.a || model.piece_body[pieces.b] != pair.b;
    };
    if (std::ranges::any_of(std::span(piece_pairs_).subspan(begin, listed_end - begin), of_others))
      return false;
    listed_end = begin;
  }
  return slots_.hold(contacts);
}

}  // namespace talus
