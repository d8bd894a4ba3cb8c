// Throws, and no std::exception, while it is loaded.
#include "area_law.hpp"

namespace {

struct Throws {
  Throws() { throw 42; }
};
const Throws throws;

constexpr talus::Component components[] = {spoilt::area_law<spoilt::AreaLaw>("throws_when_loaded")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
