// Nothing is wrong with it.
#include "elastic_rock.hpp"

namespace {

using namespace spoilt;

class RightRock final : public ElasticRock {
 public:
  using ElasticRock::ElasticRock;
};

constexpr talus::Component components[] = {rock<RightRock>("right_rock")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
