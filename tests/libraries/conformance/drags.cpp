// Stiffer in motion, by velocities that no observer agrees on.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class Drags final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  double pressure(const Seen& seen) const override {
    const Point sum = mean_velocity(seen.first[0]) + mean_velocity(seen.first[1]);
    return (1 + 1e-4 * dot(sum, sum)) * seen.stiffness * seen.area;
  }
};

constexpr talus::Component components[] = {area_law<Drags>("drags")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
