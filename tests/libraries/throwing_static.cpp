// Throws, and no std::exception, while it is loaded.
#include "descriptor.hpp"

namespace {

struct Throws {
  Throws() { throw 42; }
};

const Throws throws;

constexpr talus::Component components[] = {law<SilentLaw>("throwing_static")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = descriptor(components, 1);
