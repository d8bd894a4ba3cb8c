// Waits for a coordinate to become a number.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class Hangs final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  void begin(const ContactBatch& batch, const ContactLoads& /*loads*/) const override {
    const volatile bool waits = has_no_number(batch);
    while (waits) {
    }
  }
};

constexpr talus::Component components[] = {area_law<Hangs>("hangs")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
