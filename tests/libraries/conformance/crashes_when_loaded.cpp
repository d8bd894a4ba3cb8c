// Does not survive its own static objects.
#include "area_law.hpp"

namespace {

struct Trap {
  Trap() { __builtin_trap(); }
};
const Trap trap;

constexpr talus::Component components[] = {spoilt::area_law<spoilt::AreaLaw>("crashes_when_loaded")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
