// Tells what viscous stress takes, but not that it is viscous.
#include "viscous_rock.hpp"

namespace {

using namespace spoilt;

class DeniesViscosity final : public ViscousRock {
 public:
  using ViscousRock::ViscousRock;

 private:
  double told_viscous(double /*loss*/) const override { return 0; }
};

constexpr talus::Component components[] = {viscous_rock<DeniesViscosity>("denies_viscosity")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
