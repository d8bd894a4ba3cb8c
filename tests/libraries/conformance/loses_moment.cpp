// Friction acts on the two bodies 0.1 mm apart: ΣM is not zero.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class LosesMoment final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  Point friction_point(const Seen& seen, int body) const override {
    return seen.centre + (body == 1 ? 1e-4 : -1e-4) * seen.normal;
  }
};

constexpr talus::Component components[] = {area_law<LosesMoment>("loses_moment")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
