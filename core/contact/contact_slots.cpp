#include "contact/contact_stage.hpp"
#include "contact/room.hpp"

#include <algorithm>

namespace talus {

/// Gives every pair its contact slots, one pair after the other, and moves its contacts there. Where they are
/// now slot_start tells, counted from the first of all, rising from pair to pair.
void ContactStage::lay_out_slots(std::span<const std::uint32_t> capacities) {
  const std::size_t chunks = (pairs_.size() + pair_chunk - 1) / pair_chunk;
  slot_base_.assign(chunks + 1, 0);
  for (std::size_t i = 0; i < pairs_.size(); ++i) slot_base_[i / pair_chunk + 1] += capacities[i];
  std::uint32_t most = 0;
  for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
    most = std::max(most, slot_base_[chunk + 1]);
    slot_base_[chunk + 1] += slot_base_[chunk];
  }
  for (Workspace& workspace : workspaces_) {
    make_room_in(workspace.history, std::size_t{most} * history_doubles_);
    workspace.history.resize(std::size_t{most} * history_doubles_);
  }
  move_slots(1, capacities, reports_);
  move_slots(history_doubles_, capacities, history_);
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    BodyPair& pair = pairs_[i];
    pair.slot_start = i % pair_chunk == 0 ? 0 : pairs_[i - 1].slot_start + pairs_[i - 1].slot_capacity;
    pair.slot_capacity = capacities[i];
  }
}

/// Within one array: first to the front as closely as they go, then from the last on to their places.
template <class Value>
void ContactStage::move_slots(std::size_t values_per_slot, std::span<const std::uint32_t> capacities,
                              std::vector<Value>& values) {
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
