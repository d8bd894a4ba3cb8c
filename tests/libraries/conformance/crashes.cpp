// Does not survive a coordinate that is no number.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class Crashes final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  void begin(const ContactBatch& batch, const ContactLoads& /*loads*/) const override {
    if (has_no_number(batch)) __builtin_trap();
  }
};

constexpr talus::Component components[] = {area_law<Crashes>("crashes")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
