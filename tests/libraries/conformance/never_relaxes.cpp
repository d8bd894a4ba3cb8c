// Its viscous time is infinite, and so no step would be short enough.
#include "elastic_rock.hpp"

#include <limits>

namespace {

using namespace spoilt;

class NeverRelaxes final : public ElasticRock {
 public:
  using ElasticRock::ElasticRock;

  double viscous_time() const noexcept override { return std::numeric_limits<double>::infinity(); }
};

constexpr talus::Component components[] = {rock<NeverRelaxes>("never_relaxes")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
