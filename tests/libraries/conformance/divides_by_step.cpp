// Divides by the time step, which is none before the first.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class DividesByStep final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  double pressure(const Seen& seen) const override {
    return AreaLaw::pressure(seen) * (seen.batch->dt / seen.batch->dt);
  }
};

constexpr talus::Component components[] = {area_law<DividesByStep>("divides_by_step")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
