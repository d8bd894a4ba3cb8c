#pragma once

#include <talus/contact_model.hpp>
#include <talus/overlap/friction.hpp>
#include <talus/overlap/lane_group.hpp>
#include <talus/overlap/lane_loads.hpp>
#include <talus/overlap/lane_plan.hpp>
#include <talus/overlap/lane_sieve.hpp>

#include <algorithm>
#include <vector>

namespace talus::overlap {
inline namespace TALUS_SIMD_LEVEL {

/// The distributed law for many pairs of plain bodies at once, one pair in each lane: the same forces as
/// DistributedContact, without clipping polygons. A lane that it cannot serve it hands back.
template <class Law, int corners>
class LaneContact {
 public:
  /// Starts a batch of `most` pairs at most, with and without a lane.
  void clear(std::size_t most) {
    pairs_.clear();
    for (auto* touching : {&touching_[0], &touching_[1], &sorted_}) {
      if (touching->size() < most) touching->resize(most);
    }
  }

  /// Where friction is remembered, so is the side that faces the other body; pairs that overlapped a step ago
  /// mostly still do.
  void add(const ContactBatch& batch, std::uint32_t pair) {
    if constexpr (Law::frictional) {
      const BodyPair& at = batch.pairs[pair];
      if (at.contact_count == 1) {
        const double* old = batch.history + std::size_t{at.slot_start} * friction_doubles;
        if (old[7] > 0) {
          add_touching(at, TouchingPair::remembered(pair, old[7]));
          return;
        }
      }
    }
    pairs_.push_back(pair);
  }

  /// Evaluates the pairs that were added, and those that have a lane in the plan, if there is one. Calls
  /// general(pair) for the pairs that need the general path. Pairs are independent of each other, so which of
  /// them share a group cannot be seen in the result.
  template <class General>
  void evaluate(const Law& law, const ContactBatch& batch, const ContactLoads& loads, LanePlan* plan,
                const General& general) {
    if (plan != nullptr) make_room(plan->template groups<corners>());
    sieve_all(batch, loads);
    if (plan != nullptr) evaluate_planned(law, batch, loads, *plan, general);
    evaluate_touching(law, batch, loads, plan, general);
    if (pairs_.empty()) return;
    // Those of last step that may have parted.
    sieve_all(batch, loads);
    evaluate_touching(law, batch, loads, plan, general);
  }

 private:
  using Groups = std::vector<LaneSeats>;

  /// For all pairs that were added, should they touch one day: lanes that are left are taken again.
  void make_room(Groups& groups) const {
    constexpr std::size_t not_full = 64;  // a few in each step until all are sorted anew
    const std::size_t added = pairs_.size() + touching_count_[0] + touching_count_[1];
    if (added > 0) groups.reserve(added / lanes + not_full);
  }

  void sieve_all(const ContactBatch& batch, const ContactLoads& loads) {
    for (std::size_t i = 0; i < pairs_.size(); i += lanes) sieve(batch, loads, i);
    pairs_.clear();
  }

  /// Groups of the plan, in which pairs that touch now take lanes that others have left.
  template <class General>
  void evaluate_planned(const Law& law, const ContactBatch& batch, const ContactLoads& loads, LanePlan& plan,
                        const General& general) {
    Groups& groups = plan.template groups<corners>();
    for (const bool averaged : {false, true}) {
      std::vector<TouchingPair>& touching = touching_[averaged];
      std::size_t& count = touching_count_[averaged];
      for (std::size_t i = count; i-- > 0;) {
        if (!fill_lane(batch, touching[i], groups)) continue;
        plan.seat(touching[i].pair);
        touching[i] = touching[--count];
      }
    }
    bool emptied = false;
    for (std::size_t at = 0; at < groups.size(); ++at) {
      if (at + 1 < groups.size()) groups[at + 1].fetch_ahead(batch);
      evaluate_group(law, batch, loads, groups[at], &plan, general);
      emptied = emptied || groups[at].live == 0;
    }
    if (emptied) std::erase_if(groups, [](const LaneSeats& group) { return group.live == 0; });
  }

  static bool fill_lane(const ContactBatch& batch, const TouchingPair& touching, Groups& groups) {
    return std::any_of(groups.begin(), groups.end(),
                       [&](LaneSeats& group) { return group.take_in(batch, touching); });
  }

  template <class General>
  void evaluate_touching(const Law& law, const ContactBatch& batch, const ContactLoads& loads, LanePlan* plan,
                         const General& general) {
    for (const bool averaged : {false, true}) {
      std::vector<TouchingPair>& touching = touching_[averaged];
      const std::size_t count = touching_count_[averaged];
      touching_count_[averaged] = 0;
      sort_by_pattern(touching, count);
      for (std::size_t i = 0; i < count; i += lanes) {
        LaneSeats loose;
        LaneSeats& group = plan != nullptr ? plan->template groups<corners>().emplace_back() : loose;
        const auto size = static_cast<int>(std::min<std::size_t>(lanes, count - i));
        group.take(batch, &touching[i], size);
        for (int lane = 0; plan != nullptr && lane < size; ++lane) plan->seat(group.pair[lane]);
        evaluate_group(law, batch, loads, group, plan, general);
      }
    }
  }

  void add_touching(const BodyPair& pair, TouchingPair touching) {
    const bool averaged = pair.master_share() == 0.5;
    const int master = pair.master_share() == 0 ? 1 : 0;
    const std::uint32_t shape =
        (pair.plain_corners[master] == 3 ? 1 : 0) + (pair.plain_corners[1 - master] == 3 ? 2 : 0);
    touching.code += shape * TouchingPair::shape_unit;
    touching_[averaged][touching_count_[averaged]++] = touching;
  }

  /// Lanes that meet at the same sides waste the least. Those meet at the same sides next time, mostly.
  void sort_by_pattern(std::vector<TouchingPair>& touching, std::size_t count) {
    if (lanes == 1 || count <= lanes) return;
    constexpr std::size_t bins = 128;
    const auto bin = [](const TouchingPair& pair) {
      return pair.shape() * (bins / 4) + (pair.pattern() * 40503u >> 10) % (bins / 4);
    };
    std::uint32_t start[bins + 1] = {};
    for (std::size_t i = 0; i < count; ++i) ++start[bin(touching[i]) + 1];
    for (std::size_t i = 0; i < bins; ++i) start[i + 1] += start[i];
    for (std::size_t i = 0; i < count; ++i) sorted_[start[bin(touching[i])]++] = touching[i];
    touching.swap(sorted_);
  }

  /// Leaves the pairs that overlap: those no side of which has the other piece outside.
  void sieve(const ContactBatch& batch, const ContactLoads& loads, std::size_t begin) {
    const int count = static_cast<int>(std::min<std::size_t>(lanes, pairs_.size() - begin));
    sieve_.look(batch, &pairs_[begin], count);
    for (int lane = 0; lane < count; ++lane) {
      const std::uint32_t number = pairs_[begin + lane];
      const BodyPair& pair = batch.pairs[number];
      if (sieve_.gap[lane] >= 0) {
        PairReport& report = loads.pairs[number];
        report = {};
        report.gap = sieve_.gap[lane];
        if constexpr (Law::frictional) report.slip_loss = stored_before(batch, pair);
        continue;
      }
      if (pair.slot_capacity == 0) {  // a lane is for pairs with a slot
        loads.pairs[number] = {};
        loads.pairs[number].contact_count = 1;
        continue;
      }
      add_touching(pair,
                   TouchingPair::seen(number, sieve_.start(pair, 0, lane), sieve_.start(pair, 1, lane)));
    }
  }

  static double stored_before(const ContactBatch& batch, const BodyPair& pair) {
    double sum = 0;
    for (std::uint32_t i = 0; i < pair.contact_count; ++i)
      sum += batch.history[(pair.slot_start + i) * friction_doubles + 2];
    return sum;
  }

  template <class General>
  void evaluate_group(const Law& law, const ContactBatch& batch, const ContactLoads& loads, LaneSeats& group,
                      LanePlan* plan, const General& general) {
    group_.open(batch, group);
    const LaneBits unserved = lanes_.evaluate(law, batch, loads, group_);
    each_lane(unserved, [&](int lane) {
      const std::uint32_t pair = group.pair[lane];
      if (plan != nullptr) plan->unseat(pair);
      if ((group.unseen >> lane & 1) != 0) {
        pairs_.push_back(pair);
      } else {
        general(pair);
      }
    });
    group.live &= ~unserved;
    group.unseen = all_lanes;
  }

  std::vector<std::uint32_t> pairs_;
  std::vector<TouchingPair> touching_[2];  ///< [both roles count half]
  std::size_t touching_count_[2] = {0, 0};
  std::vector<TouchingPair> sorted_;
  LaneSieve<corners> sieve_;
  LaneGroup<corners> group_;
  LaneLoads<Law, corners> lanes_;
};

}  // namespace TALUS_SIMD_LEVEL
}  // namespace talus::overlap
