// Names the patches of its elements clockwise.
#include "fan.hpp"

namespace {

using namespace spoilt;

class TurnsRound final : public Fan {
 public:
  using Fan::Fan;

 private:
  bool clockwise() const override { return true; }
};

constexpr talus::Component components[] = {cover<TurnsRound>("turns_round")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
