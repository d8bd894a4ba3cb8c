#include "contact/contact_stage.hpp"

#include <algorithm>
#include <limits>

namespace talus {
namespace {

/// Of ContactStage::ask_again_: no way that bodies travel asks for this pair.
constexpr float asleep = std::numeric_limits<float>::infinity();

}  // namespace

void ContactStage::set_asleep(std::span<const std::uint32_t> island) {
  island_.assign(island.begin(), island.end());
  hold_sleeping_pairs();
}

/// Whether neither body moves. Islands do not touch each other, or they would be one.
bool ContactStage::sleeps(const BodyPair& pair) const {
  if (island_.empty()) return false;
  const bool a = island_[pair.a] != 0, b = island_[pair.b] != 0;
  return (a || b) && (a || fixed_[pair.a] != 0) && (b || fixed_[pair.b] != 0);
}

void ContactStage::hold_sleeping_pairs() {
  loads_.renew();  // what sleeps has none
  border_.clear();
  still_.clear();
  for (std::size_t b = 0; b < island_.size(); ++b) {
    still_.push_back(island_[b] != 0 ? 1 : 0);
    // It rests; once it wakes, what its corners stray is counted from the drift they had.
    if (island_[b] != 0) drift_[b] = drift_[b].with_rest();
  }
  for (std::uint32_t i = 0; i < pairs_.size(); ++i) {
    if (sleeps(pairs_[i])) {
      ask_again_[i] = asleep;
      if (pairs_[i].contact_count > 0) *slots_.dashpots(slot_of(i)) = {};
      continue;
    }
    if (ask_again_[i] == asleep) ask_again_[i] = in_this_step;
    if (island_.empty() || (island_[pairs_[i].a] == 0 && island_[pairs_[i].b] == 0)) continue;
    border_.push_back(i);
    ask_again_[i] = std::min(ask_again_[i], 0.0F);  // so that approach_ is found anew
    still_[pairs_[i].a] = still_[pairs_[i].b] = 0;
  }
}

/// Whether islands were touched that have to be evaluated, too.
bool ContactStage::wake_touched() {
  std::vector<std::uint32_t> touched;
  for (const std::uint32_t i : border_) {
    if (pairs_[i].contact_count > 0) touched.push_back(std::max(island_[pairs_[i].a], island_[pairs_[i].b]));
  }
  if (touched.empty()) return false;
  touched_.insert(touched_.end(), touched.begin(), touched.end());
  std::sort(touched_.begin(), touched_.end());
  touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  for (std::uint32_t& island : island_) {
    if (std::binary_search(touched_.begin(), touched_.end(), island)) island = 0;
  }
  hold_sleeping_pairs();
  return true;
}

}  // namespace talus
