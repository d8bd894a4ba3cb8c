// Nothing is wrong with it.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class Right final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

  talus::BatchPlan* make_plan() const noexcept override { return new talus::BatchPlan; }
};

constexpr talus::Component components[] = {area_law<Right>("right")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
