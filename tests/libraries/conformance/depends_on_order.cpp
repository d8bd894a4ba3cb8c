// Friction acts 0.1 mm on the side of the second body.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class DependsOnOrder final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  Point friction_point(const Seen& seen, int /*body*/) const override {
    return seen.centre + 1e-4 * seen.normal;
  }
};

constexpr talus::Component components[] = {area_law<DependsOnOrder>("depends_on_order")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
