// Tells half of its viscous stress.
#include "viscous_rock.hpp"

namespace {

using namespace spoilt;

class LosesViscousWork final : public ViscousRock {
 public:
  using ViscousRock::ViscousRock;

 private:
  double told_share() const override { return 0.5; }
};

constexpr talus::Component components[] = {viscous_rock<LosesViscousWork>("loses_viscous_work")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
