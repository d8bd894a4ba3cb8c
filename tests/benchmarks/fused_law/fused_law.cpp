// The shipped law in one piece with the loop that asks it, so that the compiler sees all of both; and the
// same loop for any law behind the interface. A library of its own, to be built with the flags of the shipped
// one.
#include "fused_law.hpp"

#include "overlap_area/overlap_area.cpp"

namespace {

using talus::benchmarks::LawCall;

template <class Law>
double contacts_of_step(const Law& law, const LawCall* calls, std::size_t count) {
  double sum = 0;
  for (const LawCall* call = calls; call != calls + count; ++call) {
    law.evaluate(call->batch, call->loads);
    for (std::uint32_t i = 0; i < call->batch.active_count; ++i) {
      const PairReport& report = call->loads.pairs[call->batch.active[i]];
      sum += report.stored + report.slip_loss + report.damping_power;
    }
  }
  return sum;
}

}  // namespace

extern "C" {

__attribute__((visibility("default"))) double contacts_through_interface(const talus::ContactModel& law,
                                                                         const LawCall* calls,
                                                                         std::size_t count) {
  return contacts_of_step(law, calls, count);
}

__attribute__((visibility("default"))) double contacts_fused(const talus::ContactModel& /*law*/,
                                                             const LawCall* calls, std::size_t count) {
  static constexpr double defaults[] = {0};
  const OverlapArea law(defaults);
  return contacts_of_step(law, calls, count);
}
}
