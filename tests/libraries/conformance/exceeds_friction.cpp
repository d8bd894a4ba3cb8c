// |T| goes up to 1.2 μ P.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class ExceedsFriction final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  double limit(const Seen& seen, double /*trial*/, double load) const override {
    return 1.2 * seen.friction * load;
  }
};

constexpr talus::Component components[] = {area_law<ExceedsFriction>("exceeds_friction")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
