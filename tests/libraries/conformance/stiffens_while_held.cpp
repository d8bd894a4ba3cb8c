// Presses more while friction is held.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class StiffensWhileHeld final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  double pressure(const Seen& seen) const override {
    return (seen.batch->hold_stick ? 1.3 : 1) * AreaLaw::pressure(seen);
  }
};

constexpr talus::Component components[] = {area_law<StiffensWhileHeld>("stiffens_while_held")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
