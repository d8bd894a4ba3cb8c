// Lets go of its friction where the overlap passes a joint of a straight edge.
#include "area_law.hpp"

#include <algorithm>

namespace {

using namespace spoilt;

class ForgetsAtJoints final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  double trial(const Seen& seen, double old, double slip) const override {
    const Piece& base = seen.longest[0];
    const std::uint32_t side = seen.longest_side[0];
    const double length = base.length(side), along = base.lever(side, seen.centre) * length;
    const bool passed = std::min(along, length - along) <= std::abs(slip);
    return (passed ? 0 : old) - seen.spring * slip;
  }
};

constexpr talus::Component components[] = {area_law<ForgetsAtJoints>("forgets_at_joints")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
