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
  move_reports(capacities);
  move_history(capacities);
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    BodyPair& pair = pairs_[i];
    pair.slot_start = i % pair_chunk == 0 ? 0 : pairs_[i - 1].slot_start + pairs_[i - 1].slot_capacity;
    pair.slot_capacity = capacities[i];
  }
}

/// Only what sleeps still has its own.
void ContactStage::move_reports(std::span<const std::uint32_t> capacities) {
  if (!island_.empty()) {
    std::vector<ContactReport> moved(slot_base_.back());
    std::uint32_t start = 0;
    for (std::size_t i = 0; i < pairs_.size(); start += capacities[i++])
      std::copy_n(reports_.begin() + pairs_[i].slot_start, pairs_[i].contact_count, moved.begin() + start);
    reports_.swap(moved);
  }
  make_room_in(reports_, slot_base_.back());
  reports_.resize(slot_base_.back());
}

/// Within one array: first to the front as closely as they go, then from the last on to their places.
void ContactStage::move_history(std::span<const std::uint32_t> capacities) {
  const auto at = [&](std::size_t slot) { return history_.data() + slot * history_doubles_; };
  std::size_t front = 0;
  for (const BodyPair& pair : pairs_) {
    const std::size_t from = pair.slot_start;
    if (from != front) std::copy(at(from), at(from + pair.contact_count), at(front));
    front += pair.contact_count;
  }
  const std::size_t size = std::size_t{slot_base_.back()} * history_doubles_;
  make_room_in(history_, size);
  history_.resize(size);
  std::size_t start = slot_base_.back();
  for (std::size_t i = pairs_.size(); i-- > 0;) {
    const std::size_t count = pairs_[i].contact_count;
    front -= count;
    start -= capacities[i];
    if (front != start) std::copy_backward(at(front), at(front + count), at(start + count));
  }
}

bool ContactStage::short_of_room() const {
  return std::any_of(chunk_totals_.begin(), chunk_totals_.end(),
                     [](const ChunkTotals& chunk) { return chunk.short_of_room; });
}

/// For the pairs that close() left to be asked about again.
void ContactStage::make_room() {
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    if (ask_again_[i] != in_this_step) capacities_[i] = pairs_[i].slot_capacity;
    pairs_[i].slot_start = slot_of(i);
  }
  lay_out_slots(capacities_);
}

}  // namespace talus
