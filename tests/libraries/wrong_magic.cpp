// Exports a symbol of the right name that is something else.
#include "descriptor.hpp"

namespace {

constexpr talus::Component components[] = {law<SilentLaw>("wrong_magic")};

constexpr talus::Library wrong_magic() {
  talus::Library library = descriptor(components, 1);
  library.magic = 0x12345678u;
  return library;
}

}  // namespace

TALUS_EXPORT const talus::Library talus_library = wrong_magic();
