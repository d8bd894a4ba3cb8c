#include "contact/contact_stage.hpp"

#include <algorithm>
#include <numeric>

namespace talus {
namespace {

/// With more, what laws keep of them comes from further away than it takes to find it out anew.
constexpr std::size_t most_planned_pairs = 32768;

}  // namespace

/// Gives every pair its contact slots, one pair after the other, and moves its contacts there. Where they are
/// now slot_start tells, counted from the first of all, rising from pair to pair.
void ContactStage::lay_out_slots(std::span<const std::uint32_t> capacities) {
  ++layout_;
  if (pairs_.size() > most_planned_pairs) plans_.clear();
  while (pairs_.size() <= most_planned_pairs && plans_.size() + 1 < batch_begin_.size())
    plans_.emplace_back(law_->make_plan());
  slot_base_.assign(1, 0);
  std::size_t most = 0, most_slots = 0;
  for (std::size_t batch = 0; batch + 1 < batch_begin_.size(); ++batch) {
    const auto begin = capacities.begin() + batch_begin_[batch],
               end = capacities.begin() + batch_begin_[batch + 1];
    const std::uint32_t slots = std::accumulate(begin, end, 0U);
    append_to(slot_base_, slot_base_.back() + slots);
    most = std::max(most, static_cast<std::size_t>(end - begin));
    most_slots = std::max(most_slots, std::size_t{slots});
  }
  const auto give_room = [](auto& values, std::size_t wanted) {
    make_room_in(values, wanted);
    values.resize(wanted);
  };
  for (Workspace& workspace : workspaces_) {
    give_room(workspace.active, most);
    give_room(workspace.reports, most);
    give_room(workspace.history, most_slots * history_doubles_);
  }
  move_slots(1, capacities, reports_);
  move_slots(history_doubles_, capacities, history_);
  for (std::size_t batch = 0; batch + 1 < batch_begin_.size(); ++batch) {
    std::uint32_t slot = 0;
    for (std::size_t i = batch_begin_[batch]; i < batch_begin_[batch + 1]; ++i) {
      pairs_[i].slot_start = slot;
      pairs_[i].slot_capacity = capacities[i];
      slot += capacities[i];
    }
  }
}

/// Within one array: first to the front as closely as they go, then from the last on to their places.
template <class Values>
void ContactStage::move_slots(std::size_t values_per_slot, std::span<const std::uint32_t> capacities,
                              Values& values) {
  const auto at = [&](std::size_t slot) { return values.data() + slot * values_per_slot; };
  std::size_t front = 0;
  for (const BodyPair& pair : pairs_) {
    const std::size_t from = pair.slot_start;
    if (from != front) std::copy(at(from), at(from + pair.contact_count), at(front));
    front += pair.contact_count;
  }
  const std::size_t size = slot_base_.back() * values_per_slot;
  make_room_in(values, size);
  values.resize(size);
  std::size_t start = slot_base_.back();
  for (std::size_t i = pairs_.size(); i-- > 0;) {
    const std::size_t count = pairs_[i].contact_count;
    front -= count;
    start -= capacities[i];
    if (front != start) std::copy_backward(at(front), at(front + count), at(start + count));
  }
}

/// For the pairs that close() left to be asked about again.
void ContactStage::make_room() {
  for (std::size_t i = 0; i < pairs_.size(); ++i) pairs_[i].slot_start = slot_of(i);
  lay_out_slots(capacities_);
}

}  // namespace talus
