// Says that it sweeps elements, and does nothing of the kind.
#include "elastic_rock.hpp"

namespace {

using namespace spoilt;

class SweepsOtherwise final : public ElasticRock {
 public:
  using ElasticRock::ElasticRock;

  bool sweeps() const noexcept override { return true; }
};

constexpr talus::Component components[] = {rock<SweepsOtherwise>("sweeps_otherwise")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
