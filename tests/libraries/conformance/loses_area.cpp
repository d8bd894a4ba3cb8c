// The first triangle does not quite reach the centroid.
#include "fan.hpp"

namespace {

using namespace spoilt;

class LosesArea final : public Fan {
 public:
  using Fan::Fan;

 private:
  double first_tip() const override { return 1e-6; }
};

constexpr talus::Component components[] = {cover<LosesArea>("loses_area")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
