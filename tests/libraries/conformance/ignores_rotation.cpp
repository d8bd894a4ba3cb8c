// Takes every turn for a strain.
#include "elastic_rock.hpp"

namespace {

using namespace spoilt;

class IgnoresRotation final : public ElasticRock {
 public:
  using ElasticRock::ElasticRock;

 private:
  talus::PlaneRotation rotation_of(const talus::TwoPointTensor& /*f*/) const override { return {1, 0}; }
};

constexpr talus::Component components[] = {rock<IgnoresRotation>("ignores_rotation")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
