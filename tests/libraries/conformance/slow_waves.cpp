// Declares a quarter of its stiffness: the time step would be twice what it may be.
#include "elastic_rock.hpp"

namespace {

using namespace spoilt;

class SlowWaves final : public ElasticRock {
 public:
  using ElasticRock::ElasticRock;

  void stiffest_tangent(double tangent[9]) const noexcept override {
    ElasticRock::stiffest_tangent(tangent);
    for (int i = 0; i < 9; ++i) tangent[i] /= 4;
  }
};

constexpr talus::Component components[] = {rock<SlowWaves>("slow_waves")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
