// Says that its code needs instructions no machine has, as a library built with -march=native elsewhere
// would. What runs when it is loaded ends the program, as such an instruction would.
#include "descriptor.hpp"

#include <cstdlib>

namespace {

constexpr talus::Component components[] = {law<SilentLaw>("lacking_instructions")};

constexpr talus::Library lacking_instructions() {
  talus::Library library = descriptor(components, 1);
  library.instructions |= std::uint64_t{1} << 63;
  return library;
}

const struct RunsWhenLoaded {
  RunsWhenLoaded() { std::abort(); }
} runs_when_loaded;

}  // namespace

TALUS_EXPORT const talus::Library talus_library = lacking_instructions();
