// Same ABI number, but a structure of the door has another size.
#include "descriptor.hpp"

namespace {

constexpr talus::Component components[] = {law<SilentLaw>("wrong_size")};

constexpr talus::Library wrong_size() {
  talus::Library library = descriptor(components, 1);
  library.contact_batch_size += 8;
  return library;
}

}  // namespace

TALUS_EXPORT const talus::Library talus_library = wrong_size();
