// stiffness() is in MN instead of N.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class WrongUnit final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;
  talus::ContactStiffness stiffness(const double* values, double length) const noexcept override {
    return {1e-6 * values[0] * length * length, 1e-6 * values[1], 0, 0};
  }
};

constexpr talus::Component components[] = {area_law<WrongUnit>("wrong_unit")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
