// Friction to the right is stronger than friction to the left.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class FavoursAHand final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  double limit(const Seen& seen, double trial, double load) const override {
    return (trial < 0 ? 0.9 : 1) * seen.friction * load;
  }
};

constexpr talus::Component components[] = {area_law<FavoursAHand>("favours_a_hand")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
