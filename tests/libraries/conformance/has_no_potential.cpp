// Squeezes the bodies lengthwise by forces that no energy tells of, and claims a potential.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class HasNoPotential final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  double squeeze() const override { return 1e-3; }
};

constexpr talus::Component components[] = {area_law<HasNoPotential>("has_no_potential")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
