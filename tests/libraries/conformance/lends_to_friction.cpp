// Books what the tangential spring stores as lost, and takes it back as it unloads.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class LendsToFriction final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  double shear_energy(const Seen& /*seen*/, double /*force*/) const override { return 0; }
};

constexpr talus::Component components[] = {area_law<LendsToFriction>("lends_to_friction")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
