// Laws whose constructors throw: one an exception with words, one a plain number.
#include "descriptor.hpp"

#include <stdexcept>

namespace {

class ThrowsWords final : public SilentLaw {
 public:
  explicit ThrowsWords(const double* values) : SilentLaw(values) {
    throw std::invalid_argument("the two stiffnesses contradict each other");
  }
};

class ThrowsNumber final : public SilentLaw {
 public:
  explicit ThrowsNumber(const double* values) : SilentLaw(values) { throw 42; }
};

constexpr talus::Component components[] = {law<ThrowsWords>("throws_words"),
                                           law<ThrowsNumber>("throws_number")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = descriptor(components, 2);
