// Right in every respect; its law carries the name of a built-in one.
#include "descriptor.hpp"

namespace {

constexpr talus::Component components[] = {law<SilentLaw>("overlap_area")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = descriptor(components, 1);
