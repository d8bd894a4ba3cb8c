// Nothing is wrong with it: it is viscous, whatever a user says.
#include "viscous_rock.hpp"

namespace {

using namespace spoilt;

constexpr talus::Parameter parameters[] = {
    viscous_parameters[0],
    talus::number("loss_time", "s", 1e-4, 0, talus::unbounded, "Viscous stress per elastic stress.")};

class RightViscousRock final : public ViscousRock {
 public:
  using ViscousRock::ViscousRock;
};

constexpr talus::Component components[] = {talus::material<RightViscousRock>(
    "right_viscous_rock", "A material for tests.", parameters, talus::trait::has_potential)};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
