// Built against the headers of another ABI. Members beyond the number are garbage on purpose: a program that
// reads them before the number crashes.
#include "descriptor.hpp"

namespace {

constexpr talus::Component components[] = {law<SilentLaw>("wrong_abi")};

constexpr talus::Library wrong_abi() {
  talus::Library library = descriptor(components, 1);
  library.abi = talus::abi_number + 41;
  library.library_size = 0;
  library.units = nullptr;
  library.name = nullptr;
  library.components = nullptr;
  library.component_count = 0xFFFFFFFFu;
  return library;
}

}  // namespace

TALUS_EXPORT const talus::Library talus_library = wrong_abi();
