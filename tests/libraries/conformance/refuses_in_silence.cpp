// Refuses every body, and does not say why.
#include "fan.hpp"

namespace {

using namespace spoilt;

class RefusesInSilence final : public Fan {
 public:
  using Fan::Fan;

  void build(const talus::BodyShape& /*body*/, talus::CoverSink& sink) const noexcept override {
    sink.refuse(nullptr);
  }
};

constexpr talus::Component components[] = {cover<RefusesInSilence>("refuses_in_silence")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
