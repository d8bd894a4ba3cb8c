// Presses on the inner sides of pieces as well, where bodies were divided.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class LoadsCuts final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  bool bears(const Piece& piece, std::uint32_t side) const override { return piece.length(side) > 0; }
};

constexpr talus::Component components[] = {area_law<LoadsCuts>("loads_cuts")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
