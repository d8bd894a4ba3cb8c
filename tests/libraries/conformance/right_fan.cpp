// Nothing is wrong with it.
#include "fan.hpp"

namespace {

using namespace spoilt;

class RightFan final : public Fan {
 public:
  using Fan::Fan;
};

constexpr talus::Component components[] = {cover<RightFan>("right_fan")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
