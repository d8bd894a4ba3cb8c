// The patch at the centroid is to follow three corners, wherever they are.
#include "fan.hpp"

namespace {

using namespace spoilt;

class SteadiesAskew final : public Fan {
 public:
  using Fan::Fan;

 private:
  void finish(std::uint32_t centre, const std::vector<std::uint32_t>& patch,
              talus::CoverSink& sink) const override {
    const std::uint32_t to[3] = {patch[0], patch[1], patch[2]};
    constexpr double weights[3] = {0.4, 0.3, 0.3};
    sink.steady_patch(centre, to, weights, 1);
  }
};

constexpr talus::Component components[] = {cover<SteadiesAskew>("steadies_askew")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
