// Books twice the energy that its stress has taken.
#include "elastic_rock.hpp"

namespace {

using namespace spoilt;

class StoresDouble final : public ElasticRock {
 public:
  using ElasticRock::ElasticRock;

 private:
  double energy(double stored) const override { return 2 * stored; }
};

constexpr talus::Component components[] = {rock<StoresDouble>("stores_double", 0)};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
