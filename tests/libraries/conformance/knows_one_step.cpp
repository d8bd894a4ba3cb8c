// Slip is counted as if all steps took 0.1 ms.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class KnowsOneStep final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  double time_step(const ContactBatch&) const override { return 1e-4; }
};

constexpr talus::Component components[] = {area_law<KnowsOneStep>("knows_one_step")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
