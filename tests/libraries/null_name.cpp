// Forgot to say what it is called.
#include "descriptor.hpp"

namespace {

constexpr talus::Component components[] = {law<SilentLaw>("null_name")};

constexpr talus::Library null_name() {
  talus::Library library = descriptor(components, 1);
  library.name = nullptr;
  return library;
}

}  // namespace

TALUS_EXPORT const talus::Library talus_library = null_name();
