// Brings a law of its own, and another under a name that a built-in library has: neither may be taken.
#include "descriptor.hpp"

namespace {

constexpr talus::Component components[] = {law<SilentLaw>("blameless"), law<SilentLaw>("overlap_area")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = descriptor(components, 2);
