// Throws at a coordinate that is no number, where nothing may be thrown.
#include "area_law.hpp"

#include <stdexcept>

namespace {

using namespace spoilt;

class ThrowsWithin final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  void begin(const ContactBatch& batch, const ContactLoads& /*loads*/) const override {
    if (has_no_number(batch)) throw std::runtime_error("no place for this corner");
  }
};

constexpr talus::Component components[] = {area_law<ThrowsWithin>("throws_within")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
