// Tells half of what viscous stress takes.
#include "viscous_rock.hpp"

namespace {

using namespace spoilt;

class LosesViscousWork final : public ViscousRock {
 public:
  using ViscousRock::ViscousRock;

 private:
  double told_loss(double loss) const override { return loss / 2; }
  double told_viscous(double loss) const override { return loss / 2; }
};

constexpr talus::Component components[] = {viscous_rock<LosesViscousWork>("loses_viscous_work")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
