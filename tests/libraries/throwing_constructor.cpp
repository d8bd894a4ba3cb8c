// Laws whose constructors throw: exceptions with words, with words for no terminal and with none, and a plain
// number.
#include "descriptor.hpp"

#include <stdexcept>
#include <string>

namespace {

class ThrowsWords final : public SilentLaw {
 public:
  explicit ThrowsWords(const double* values) : SilentLaw(values) {
    throw std::invalid_argument("the two stiffnesses contradict each other");
  }
};

class ThrowsControls final : public SilentLaw {
 public:
  explicit ThrowsControls(const double* values) : SilentLaw(values) {
    throw std::invalid_argument("\x1b[31mtoo\nred\xff");
  }
};

class ThrowsLong final : public SilentLaw {
 public:
  explicit ThrowsLong(const double* values) : SilentLaw(values) {
    std::string words;  // the end of the room is within a letter
    for (int i = 0; i < 400; ++i) words += "ä";
    throw std::invalid_argument(words);
  }
};

class ThrowsSilence final : public SilentLaw {
 public:
  explicit ThrowsSilence(const double* values) : SilentLaw(values) { throw std::invalid_argument(""); }
};

class ThrowsNumber final : public SilentLaw {
 public:
  explicit ThrowsNumber(const double* values) : SilentLaw(values) { throw 42; }
};

constexpr talus::Component components[] = {
    law<ThrowsWords>("throws_words"), law<ThrowsControls>("throws_controls"),
    law<ThrowsSilence>("throws_silence"), law<ThrowsNumber>("throws_number"), law<ThrowsLong>("throws_long")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = descriptor(components, 5);
