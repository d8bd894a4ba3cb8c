// Tells of contacts that stick that they slip, and the other way round.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class TellsSlipWrong final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  double slipping(bool slips) const override { return slips ? 0 : 1; }
};

constexpr talus::Component components[] = {area_law<TellsSlipWrong>("tells_slip_wrong")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
