// Declares waves that would run backwards: its stiffness with the other sign.
#include "elastic_rock.hpp"

namespace {

using namespace spoilt;

class FallsBack final : public ElasticRock {
 public:
  using ElasticRock::ElasticRock;

  void stiffest_tangent(double tangent[9]) const noexcept override {
    ElasticRock::stiffest_tangent(tangent);
    for (int i = 0; i < 9; ++i) tangent[i] *= -1;
  }
};

constexpr talus::Component components[] = {rock<FallsBack>("falls_back")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
