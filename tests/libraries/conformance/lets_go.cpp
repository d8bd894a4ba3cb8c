// Lets friction slip while a scene settles that is to hold it.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class LetsGo final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  bool holds_stick(const ContactBatch&) const override { return false; }
};

constexpr talus::Component components[] = {area_law<LetsGo>("lets_go")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
