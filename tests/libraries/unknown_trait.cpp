// Claims what this talus knows nothing of.
#include "descriptor.hpp"

namespace {

constexpr talus::Component with_traits() {
  talus::Component component = law<SilentLaw>("unknown_trait");
  component.traits = 0x101;
  return component;
}

constexpr talus::Component components[] = {with_traits()};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = descriptor(components, 1);
