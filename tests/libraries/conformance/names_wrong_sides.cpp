// The boundary follows the side behind the one it names.
#include "fan.hpp"

namespace {

using namespace spoilt;

class NamesWrongSides final : public Fan {
 public:
  using Fan::Fan;

 private:
  std::uint32_t side_at(std::uint32_t corner, std::uint32_t corners) const override {
    return (corner + 1) % corners;
  }
};

constexpr talus::Component components[] = {cover<NamesWrongSides>("names_wrong_sides")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
