// Where one body is the sole master, friction drives on what slides faster than half a metre per second.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class RubsForward final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  double trial(const Seen& seen, double old, double slip) const override {
    const bool sole = seen.pair->master_share() != 0.5, quick = std::fabs(slip) > 0.5 * seen.batch->dt;
    return old - (sole && quick ? -1 : 1) * seen.spring * slip;
  }
};

constexpr talus::Component components[] = {area_law<RubsForward>("rubs_forward")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
