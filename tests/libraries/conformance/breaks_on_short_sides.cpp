// Divides by the length of a side.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class BreaksOnShortSides final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  double pressure(const Seen& seen) const override {
    return (1 + 0 * (1 / seen.shortest)) * seen.stiffness * seen.area;
  }
};

constexpr talus::Component components[] = {area_law<BreaksOnShortSides>("breaks_on_short_sides")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
