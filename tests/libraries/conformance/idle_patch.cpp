// A patch too many, which no element uses.
#include "fan.hpp"

namespace {

using namespace spoilt;

class IdlePatch final : public Fan {
 public:
  using Fan::Fan;

 private:
  void finish(std::uint32_t /*centre*/, const std::vector<std::uint32_t>& /*patch*/,
              talus::CoverSink& sink) const override {
    sink.add_patch(0.1, 0.1);
  }
};

constexpr talus::Component components[] = {cover<IdlePatch>("idle_patch")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
