// Tells what viscous stress takes, but not that it is viscous.
#include "viscous_rock.hpp"

namespace {

using namespace spoilt;

class DeniesViscosity final : public ViscousRock {
 public:
  using ViscousRock::ViscousRock;

 private:
  double told_share() const override { return 0; }
  double told_loss(double viscous) const override { return viscous; }
};

constexpr talus::Component components[] = {viscous_rock<DeniesViscosity>("denies_viscosity")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
