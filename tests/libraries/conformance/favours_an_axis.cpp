// A contact is a thousandth softer along y than along x.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class FavoursAnAxis final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  double pressure(const Seen& seen) const override {
    return (1 - 1e-3 * seen.normal.y * seen.normal.y) * seen.stiffness * seen.area;
  }
};

constexpr talus::Component components[] = {area_law<FavoursAnAxis>("favours_an_axis", 0)};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
