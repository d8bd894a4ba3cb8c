// As bodies touch energy is there that nobody has put in.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class StoresAtOnce final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  double stored(const Seen&, double energy) const override { return energy + 0.01; }
};

constexpr talus::Component components[] = {area_law<StoresAtOnce>("stores_at_once")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
