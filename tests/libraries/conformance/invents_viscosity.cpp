// Tells what it stores as work of viscous stress.
#include "elastic_rock.hpp"

namespace {

using namespace spoilt;

class InventsViscosity final : public ElasticRock {
 public:
  using ElasticRock::ElasticRock;

 private:
  double viscous(double stored) const override { return stored; }
};

constexpr talus::Component components[] = {rock<InventsViscosity>("invents_viscosity")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
