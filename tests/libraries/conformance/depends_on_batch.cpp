// Stiffer by 1e-13 with each pair that comes before it in the batch.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class DependsOnBatch final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  double pressure(const Seen& seen) const override {
    return (1 + 1e-13 * seen.position) * seen.stiffness * seen.area;
  }
};

constexpr talus::Component components[] = {area_law<DependsOnBatch>("depends_on_batch")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
