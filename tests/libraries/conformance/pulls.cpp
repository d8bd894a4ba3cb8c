// A contact that opens faster than 1 m/s holds on.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class Pulls final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  double pressure(const Seen& seen) const override {
    const double parting = dot(mean_velocity(seen.first[1]) - mean_velocity(seen.first[0]), seen.normal);
    return (parting > 1 ? -0.1 : 1) * seen.stiffness * seen.area;
  }
};

constexpr talus::Component components[] = {area_law<Pulls>("pulls")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
