// Where one body is the sole master, springs of friction are let go more softly than they were loaded.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class GainsAsMaster final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  double trial(const Seen& seen, double old, double slip) const override {
    const bool sole = seen.pair->master_share() != 0.5;
    return old - (sole && old * slip > 0 ? 0.9 : 1) * seen.spring * slip;
  }
};

constexpr talus::Component components[] = {area_law<GainsAsMaster>("gains_as_master")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
