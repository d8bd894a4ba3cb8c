// Nothing is wrong with it.
#include "damped_law.hpp"

namespace {

using namespace spoilt;

class RightDamped final : public DampedLaw {
 public:
  using DampedLaw::DampedLaw;
};

constexpr talus::Component components[] = {damped_law<RightDamped>("right_damped")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
