// Measures in other units.
#include "descriptor.hpp"

namespace {

constexpr talus::Component components[] = {law<SilentLaw>("wrong_units")};

constexpr talus::Library wrong_units() {
  talus::Library library = descriptor(components, 1);
  library.units = "SI: mm t s, radian, per millimetre of thickness";
  return library;
}

}  // namespace

TALUS_EXPORT const talus::Library talus_library = wrong_units();
