// Declares a default that it would refuse from a user.
#include "descriptor.hpp"

namespace {

constexpr talus::Parameter parameters[] = {talus::number("share", "-", 1.5, 0, 1, "A share.")};

constexpr talus::Component out_of_range() {
  talus::Component component = law<SilentLaw>("default_out_of_range");
  component.parameters = parameters;
  component.parameter_count = 1;
  return component;
}

constexpr talus::Component components[] = {law<SilentLaw>("blameless"), out_of_range()};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = descriptor(components, 2);
