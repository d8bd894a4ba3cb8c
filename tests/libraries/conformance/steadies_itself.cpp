// The patch at the centroid is to follow itself.
#include "fan.hpp"

namespace {

using namespace spoilt;

class SteadiesItself final : public Fan {
 public:
  using Fan::Fan;

 private:
  void finish(std::uint32_t centre, const std::vector<std::uint32_t>& patch,
              talus::CoverSink& sink) const override {
    const std::uint32_t to[3] = {patch[0], centre, patch[1]};
    constexpr double weights[3] = {0, 1, 0};
    sink.steady_patch(centre, to, weights, 1);
  }
};

constexpr talus::Component components[] = {cover<SteadiesItself>("steadies_itself")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
