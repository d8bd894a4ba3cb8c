#include "contact/law_fault.hpp"

#include "contact/contact_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace talus {
namespace {

/// Share of the loads between two bodies that may be left over: rounding leaves 1e-12, a load in a wrong
/// place its own size. And an overlap, share of the bodies' reach, that is rounding itself: what it weighs
/// along a side of that reach may be left over, too.
constexpr double allowed_share = 1e-6, least_overlap = 1e-12;
constexpr std::uint32_t most_contacts = 1'000'000;  ///< of one pair

/// What the loads between two bodies add up to.
struct PairSum {
  double x = 0, y = 0, moment = 0;  ///< N/m and N, about the first corner
  double size = 0, moments = 0;     ///< N/m and N, of all loads without their signs
  double reach = 0;                 ///< m, of the corners
  bool finite = true;
};

bool is_finite(const ContactReport& report) {
  return std::isfinite((report.x + report.y + report.px + report.py) +
                       (report.tx + report.ty + report.penetration + report.slipping + report.moment));
}

}  // namespace

/// A pair that asks for room without end.
LawFault ContactStage::runaway() const {
  for (const auto& [pair, contacts] : short_of_room_) {
    if (contacts <= most_contacts) continue;
    return {fmt::format("more than {} contacts of one pair", most_contacts), true, pairs_[pair].a,
            pairs_[pair].b};
  }
  return {};
}

/// Of the pairs of the wave that was evaluated last. Looks at loads only where the host takes them from.
LawFault ContactStage::fault_of(const Model& model, const MotionState& motion, const Wave& wave) const {
  if (!loads_.intact()) return {"a load written past the last corner of all pairs"};
  for (std::size_t i = wave.first_chunk; i < wave.end_chunk; ++i) {
    if (chunk_totals_[i].unsound == no_pair) continue;
    const BodyPair& pair = pairs_[chunk_totals_[i].unsound];
    return {"a report that is no number", true, pair.a, pair.b};
  }
  const PiecePairs all = piece_pairs();
  const auto sum_of = [&](const BodyPair& pair) {
    PairSum sum;
    double first_x = 0, first_y = 0;
    bool first = true;
    for (const PiecePair pieces : all.of(pair)) {
      std::uint32_t load = pieces.load_start;
      for (const bool of_b : {false, true}) {
        const std::uint32_t piece = of_b ? pieces.b : pieces.a;
        const std::uint32_t begin = model.piece_start[piece], end = model.piece_start[piece + 1];
        const std::uint32_t loaded = model.is_strip[piece] != 0 ? begin + 2 : end;
        for (std::uint32_t c = begin; c < end; ++c, ++load) {
          if (c >= loaded) continue;
          const double x = motion.corners[c].x + (of_b ? pair.offset_x : 0);
          const double y = motion.corners[c].y + (of_b ? pair.offset_y : 0);
          if (std::exchange(first, false)) first_x = x, first_y = y;
          const auto [fx, fy] = loads_.corner()[load];
          const double arm_x = x - first_x, arm_y = y - first_y;
          sum.x += fx, sum.y += fy, sum.moment += arm_x * fy - arm_y * fx;
          sum.size += std::abs(fx) + std::abs(fy);
          sum.moments += std::abs(arm_x * fy) + std::abs(arm_y * fx);
          sum.reach = std::max(sum.reach, std::abs(arm_x) + std::abs(arm_y));
          sum.finite = sum.finite && std::isfinite(fx) && std::isfinite(fy);
        }
      }
    }
    return sum;
  };
  const double stiffest = stiffest_interface();
  for (std::size_t i = wave.begin; i < wave.end; ++i) {
    const BodyPair& pair = pairs_[i];
    if (pair.contact_count == 0 || (!island_.empty() && sleeps(pair))) continue;
    if (!std::ranges::all_of(reports_of(i), is_finite))
      return {"a contact report that is no number", true, pair.a, pair.b};
    const PairSum sum = sum_of(pair);
    if (!sum.finite) return {"a load that is no number", true, pair.a, pair.b};
    const double force = std::hypot(sum.x, sum.y), moment = std::abs(sum.moment);
    const double weightless = stiffest * least_overlap * sum.reach * sum.reach;
    if (force > allowed_share * sum.size + weightless) {
      return {fmt::format("loads that leave a force of {:.3g} N/m over, of {:.3g}", force, sum.size), true,
              pair.a, pair.b};
    }
    if (moment > allowed_share * sum.moments + weightless * sum.reach) {
      return {fmt::format("loads that leave a moment of {:.3g} N over, of {:.3g}", moment, sum.moments), true,
              pair.a, pair.b};
    }
  }
  return {};
}

/// N/m per metre of overlap and metre of thickness, on a metre of side.
double ContactStage::stiffest_interface() const {
  double stiffest = 0;
  const std::size_t parameters = interfaces_.parameter_count;
  for (std::size_t at = 0; at < interface_values_.size(); at += std::max<std::size_t>(parameters, 1))
    stiffest = std::max(stiffest, law_->stiffness(&interface_values_[at], 1).normal);
  return stiffest;
}

}  // namespace talus
