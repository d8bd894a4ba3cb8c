// Takes the first interface of the scene, whichever applies.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class KnowsOneInterface final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  std::uint32_t row(const talus::Interfaces&) const override { return 0; }
};

constexpr talus::Component components[] = {area_law<KnowsOneInterface>("knows_one_interface")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
