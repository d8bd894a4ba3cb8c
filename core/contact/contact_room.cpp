#include "contact/contact_stage.hpp"

#include <algorithm>

namespace talus {
namespace {

/// Slots for a pair that asked for more than it has. Convex bodies mostly have one contact for good.
std::uint32_t room_for(const BodyPair& pair, std::uint32_t contacts) {
  return pair.slot_capacity == 0 && pair.plain() ? contacts : 2 * contacts;
}

}  // namespace

/// After ContactSlots::close_up(), and where pairs were divided into batches.
void ContactStage::lay_out_slots() {
  ++layout_;
  while (plans_.size() + 1 < batch_begin_.size()) plans_.emplace_back(law_->make_plan());
  slots_.lay_out(pairs_, batch_begin_);
  size_workspaces();
}

/// Whether close() left pairs to be asked about again. Which thread came upon them is forgotten.
bool ContactStage::some_short_of_room() {
  short_of_room_.clear();
  for (Workspace& workspace : workspaces_) {
    for (const ShortOfRoom& found : workspace.short_of_room) append_to(short_of_room_, found);
    workspace.short_of_room.clear();
  }
  std::sort(short_of_room_.begin(), short_of_room_.end(),
            [](const ShortOfRoom& p, const ShortOfRoom& q) { return p.pair < q.pair; });
  return !short_of_room_.empty();
}

/// For those pairs. Those that meet take slots that wait, and nobody else need know.
void ContactStage::make_room() {
  wanted_.assign(batch_begin_.size() - 1, 0);
  for (const auto& [number, contacts] : short_of_room_)
    wanted_[batch_of(number)] += room_for(pairs_[number], contacts);
  slots_.widen(wanted_);
  for (const auto& [number, contacts] : short_of_room_) {
    BodyPair& pair = pairs_[number];
    if (pair.slot_capacity > 0) ++layout_;
    slots_.give(pair, batch_of(number), room_for(pair, contacts));
  }
  size_workspaces();
}

/// For the largest batch, and all its contacts.
void ContactStage::size_workspaces() {
  std::size_t most = 0;
  for (std::size_t batch = 0; batch + 1 < batch_begin_.size(); ++batch)
    most = std::max<std::size_t>(most, batch_begin_[batch + 1] - batch_begin_[batch]);
  const auto give_room = [](auto& values, std::size_t wanted) {
    make_room_in(values, wanted);
    values.resize(wanted);
  };
  for (Workspace& workspace : workspaces_) {
    give_room(workspace.active, most);
    give_room(workspace.reports, most);
    give_room(workspace.history, slots_.most() * slots_.doubles());
    make_room_in(workspace.short_of_room, pair_chunk);
  }
  make_room_in(short_of_room_, pair_chunk);
  make_room_in(wanted_, batch_begin_.size());
}

}  // namespace talus
