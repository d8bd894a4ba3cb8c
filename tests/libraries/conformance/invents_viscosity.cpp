// Tells its stress as viscous, and so stores nothing.
#include "elastic_rock.hpp"

namespace {

using namespace spoilt;

class InventsViscosity final : public ElasticRock {
 public:
  using ElasticRock::ElasticRock;

  double viscous_time() const noexcept override { return 1e-4; }
  bool needs_previous_deformation() const noexcept override { return true; }

 private:
  double energy(double /*stored*/) const override { return 0; }
  double viscous(double stress) const override { return stress; }
};

constexpr talus::Component components[] = {rock<InventsViscosity>("invents_viscosity", 0)};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
