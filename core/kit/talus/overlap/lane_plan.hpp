#pragma once

#include <talus/overlap/lane_group.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace talus::overlap {
inline namespace TALUS_SIMD_LEVEL {

/// Which pairs of a batch have a lane, and which share a group. A pair in contact keeps its lane from step to
/// step, so that nobody need look up again where its corners are; once in a while all are sorted anew.
class LanePlan final : public BatchPlan {
 public:
  template <int corners>
  std::vector<LaneSeats>& groups() {
    if constexpr (corners == 4) return quadrilaterals_;
    if constexpr (corners == 8) return octagons_;
  }

  /// Lists the pairs to evaluate that have no lane: all, where the lanes are not those of these pairs or it
  /// is time to sort them.
  void list_loose(const ContactBatch& batch, std::vector<std::uint32_t>& loose) {
    if (batch.layout != layout_ || ++steps_ == steps_between_sorts) clear();
    layout_ = batch.layout;
    if (batch.active_count > 0) {
      const std::size_t end = batch.active[batch.active_count - 1] + std::size_t{1};
      if (seated_.size() < end) seated_.resize(end);
    }
    list(batch, loose);
    if (batch.active_count - loose.size() == seats_) return;
    clear();  // the host leaves out some that have a lane
    list(batch, loose);
  }

  void seat(std::uint32_t pair) {
    seated_[pair] = 1;
    ++seats_;
  }
  void unseat(std::uint32_t pair) {
    seated_[pair] = 0;
    --seats_;
  }

 private:
  /// Which sides meet changes slowly, so that lanes of a group soon are not alike any more.
  static constexpr std::uint32_t steps_between_sorts = 16;

  /// Nobody has a lane.
  void clear() {
    quadrilaterals_.clear();
    octagons_.clear();
    seated_.assign(seated_.size(), 0);
    seats_ = 0;
    steps_ = 0;
  }

  void list(const ContactBatch& batch, std::vector<std::uint32_t>& loose) const {
    loose.resize(batch.active_count);
    std::uint32_t* next = loose.data();
    const std::uint8_t* const seated = seated_.data();
    for (const std::uint32_t *at = batch.active, *end = at + batch.active_count; at != end; ++at) {
      *next = *at;
      next += 1 - seated[*at];
    }
    loose.resize(static_cast<std::size_t>(next - loose.data()));
  }

  std::vector<LaneSeats> quadrilaterals_;
  std::vector<LaneSeats> octagons_;
  std::vector<std::uint8_t> seated_;  ///< [pair]
  std::size_t seats_ = 0;
  std::uint32_t steps_ = 0;
  std::uint64_t layout_ = 0;
};

}  // namespace TALUS_SIMD_LEVEL
}  // namespace talus::overlap
