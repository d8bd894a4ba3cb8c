// The last triangle has a patch of its own where it meets the first.
#include "fan.hpp"

namespace {

using namespace spoilt;

class Torn final : public Fan {
 public:
  using Fan::Fan;

 private:
  std::uint32_t closing_patch(const talus::Region& outline, std::uint32_t /*first*/,
                              talus::CoverSink& sink) const override {
    return sink.add_patch(outline.x[0], outline.y[0]);
  }
};

constexpr talus::Component components[] = {cover<Torn>("torn")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
