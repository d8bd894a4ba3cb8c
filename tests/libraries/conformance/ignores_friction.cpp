// Whatever the friction angle, bodies slide freely.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class IgnoresFriction final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  double limit(const Seen&, double /*trial*/, double /*load*/) const override { return 0; }
};

constexpr talus::Component components[] = {area_law<IgnoresFriction>("ignores_friction")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
