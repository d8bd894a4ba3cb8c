// An element too many, without a region.
#include "fan.hpp"

namespace {

using namespace spoilt;

class EmptyElement final : public Fan {
 public:
  using Fan::Fan;

 private:
  void finish(std::uint32_t centre, const std::vector<std::uint32_t>& patch,
              talus::CoverSink& sink) const override {
    const std::uint32_t patches[3] = {centre, patch[0], patch[1]};
    sink.add_element(patches, {nullptr, nullptr, nullptr, 0});
  }
};

constexpr talus::Component components[] = {cover<EmptyElement>("empty_element")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
