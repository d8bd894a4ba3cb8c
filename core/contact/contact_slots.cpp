#include "contact/contact_slots.hpp"

#include <algorithm>
#include <cstring>

namespace talus {
namespace {

constexpr std::uint32_t no_bound = 0xFFFFFFFFu;

/// Slots that wait in a batch, more where there are many: a few per cent of the pairs meet between two
/// searches.
std::uint32_t waiting_for(std::size_t slots) {
  return static_cast<std::uint32_t>(8 + slots / 32);
}

std::uint32_t slots_of(std::span<const BodyPair> pairs) {
  std::uint32_t slots = 0;
  for (const BodyPair& pair : pairs) slots += pair.slot_capacity;
  return slots;
}

}  // namespace

/// Pairs that met late have their slots behind those of the pairs after them, so a batch is put aside.
void ContactSlots::close_up(std::span<BodyPair> pairs, std::span<const std::uint32_t> batch_begin) {
  over_all([&](auto& values, std::size_t per_slot) {
    const std::size_t size = per_slot * sizeof values[0];
    if (size == 0) return;
    auto* const all = reinterpret_cast<unsigned char*>(values.data());
    make_room_in(aside_, most_ * size);
    aside_.resize(most_ * size);
    unsigned char* front = all;
    for (std::size_t batch = 0; batch + 1 < batch_begin.size() && batch < taken_.size(); ++batch) {
      const unsigned char* const slots = all + base_[batch] * size;
      unsigned char* next = aside_.data();
      for (std::size_t i = batch_begin[batch]; i < batch_begin[batch + 1]; ++i) {
        const std::size_t bytes = pairs[i].contact_count * size;
        std::memcpy(next, slots + pairs[i].slot_start * size, bytes);
        next += bytes;
      }
      std::memcpy(front, aside_.data(), static_cast<std::size_t>(next - aside_.data()));
      front += next - aside_.data();
    }
    values.resize(static_cast<std::size_t>(front - all) / sizeof values[0]);
  });
  std::uint32_t slot = 0;
  for (BodyPair& pair : pairs) {
    pair.slot_start = slot;
    slot += pair.contact_count;
  }
}

void ContactSlots::lay_out(std::span<BodyPair> pairs, std::span<const std::uint32_t> batch_begin) {
  base_.assign(1, 0);
  taken_.clear();
  without_.clear();
  most_ = 0;
  for (std::size_t batch = 0; batch + 1 < batch_begin.size(); ++batch) {
    const auto own = pairs.subspan(batch_begin[batch], batch_begin[batch + 1] - batch_begin[batch]);
    append_to(taken_, slots_of(own));
    append_to(without_, static_cast<std::uint32_t>(std::ranges::count(own, 0u, &BodyPair::slot_capacity)));
    const std::size_t slots = taken_.back() + std::min(without_.back(), waiting_for(own.size()));
    append_to(base_, base_.back() + slots);
    most_ = std::max(most_, slots);
  }
  make_room_in(former_base_, base_.size());
  over_all([&](auto& values, std::size_t per_slot) {
    // Memory that nobody touches costs nothing, and to move what there is takes twice as much of it.
    make_room_in(values, std::max(base_.back(), pairs.size()) * per_slot);
    values.resize(base_.back() * per_slot);
    // From the last on: no contact has its place before the one it comes from.
    for (std::size_t batch = taken_.size(); batch-- > 0;) {
      std::size_t start = base_[batch] + taken_[batch];
      for (std::size_t i = batch_begin[batch + 1]; i-- > batch_begin[batch];) {
        start -= pairs[i].slot_capacity;
        move(values, per_slot, pairs[i].slot_start, pairs[i].contact_count, start);
      }
    }
  });
  for (std::size_t batch = 0; batch < taken_.size(); ++batch) {
    std::uint32_t slot = 0;
    for (std::size_t i = batch_begin[batch]; i < batch_begin[batch + 1]; ++i) {
      pairs[i].slot_start = slot;
      slot += pairs[i].slot_capacity;
    }
  }
}

void ContactSlots::widen(std::span<const std::uint32_t> wanted) {
  former_base_ = base_;
  for (std::size_t batch = 0; batch < taken_.size(); ++batch) {
    const std::size_t needed = std::size_t{taken_[batch]} + wanted[batch];
    std::size_t slots = former_base_[batch + 1] - former_base_[batch];
    if (needed > slots) {
      // All are for pairs that had none, or there are pairs whose contacts grow in number.
      const bool first = wanted[batch] <= without_[batch];
      slots = needed + std::min(first ? without_[batch] - wanted[batch] : no_bound, waiting_for(needed));
    }
    base_[batch + 1] = base_[batch] + slots;
    most_ = std::max(most_, slots);
  }
  if (base_.back() == former_base_.back()) return;
  over_all([&](auto& values, std::size_t per_slot) {
    make_room_in(values, base_.back() * per_slot);
    values.resize(base_.back() * per_slot);
    for (std::size_t batch = taken_.size(); batch-- > 0;)
      move(values, per_slot, former_base_[batch], taken_[batch], base_[batch]);
  });
}

void ContactSlots::give(BodyPair& pair, std::size_t batch, std::uint32_t capacity) {
  over_all([&](auto& values, std::size_t per_slot) {
    move(values, per_slot, base_[batch] + pair.slot_start, pair.contact_count, base_[batch] + taken_[batch]);
  });
  if (pair.slot_capacity == 0) --without_[batch];
  pair.slot_start = taken_[batch];
  pair.slot_capacity = capacity;
  taken_[batch] += capacity;
}

template <class Values>
void ContactSlots::move(Values& values, std::size_t per_slot, std::size_t from, std::size_t count,
                        std::size_t to) {
  if (from == to || count == 0) return;
  const auto first = values.begin() + static_cast<std::ptrdiff_t>(from * per_slot);
  std::copy_backward(first, first + static_cast<std::ptrdiff_t>(count * per_slot),
                     values.begin() + static_cast<std::ptrdiff_t>((to + count) * per_slot));
}

}  // namespace talus
