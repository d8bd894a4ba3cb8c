// Friction unloads along a flatter line than it was loaded; what is won is booked as a negative loss.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class CreatesEnergy final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  double trial(const Seen& seen, double old, double slip) const override {
    return old - (old * slip > 0 ? 0.9 : 1) * seen.spring * slip;
  }
};

constexpr talus::Component components[] = {area_law<CreatesEnergy>("creates_energy")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
