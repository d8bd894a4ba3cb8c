// Makes strain heavier in a cover of several elements, which have no strain in common.
#include "fan.hpp"

namespace {

using namespace spoilt;

class ScalesStrain final : public Fan {
 public:
  using Fan::Fan;

 private:
  void finish(std::uint32_t /*centre*/, const std::vector<std::uint32_t>& /*patch*/,
              talus::CoverSink& sink) const override {
    sink.scale_strain_mass(4);
  }
};

constexpr talus::Component components[] = {cover<ScalesStrain>("scales_strain")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
