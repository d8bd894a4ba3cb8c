// Tells a tenth more than its dashpots take.
#include "damped_law.hpp"

namespace {

using namespace spoilt;

class OverstatesDamping final : public DampedLaw {
 public:
  using DampedLaw::DampedLaw;

 private:
  double told_power(double power) const override { return 1.1 * power; }
};

constexpr talus::Component components[] = {damped_law<OverstatesDamping>("overstates_damping")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
