// Presses more while bonds form, of which it has none, and does not store it.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class StiffensWhileBondsForm final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  double pressure(const Seen& seen) const override {
    return (seen.batch->bonds_form ? 1.2 : 1) * AreaLaw::pressure(seen);
  }
  double stored(const Seen& seen, double /*energy*/) const override {
    return AreaLaw::pressure(seen) * seen.area / 2;
  }
};

constexpr talus::Component components[] = {area_law<StiffensWhileBondsForm>("stiffens_while_bonds_form")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
