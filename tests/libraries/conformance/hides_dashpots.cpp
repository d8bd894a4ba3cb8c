// Damps, and says what power that takes, but not the force.
#include "damped_law.hpp"

namespace {

using namespace spoilt;

class HidesDashpots final : public DampedLaw {
 public:
  using DampedLaw::DampedLaw;

 private:
  double told_force(double /*force*/) const override { return 0; }
};

constexpr talus::Component components[] = {damped_law<HidesDashpots>("hides_dashpots")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
