// Softer by a thousandth for each corner within the other body, joints of a straight edge included.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class KicksAtJoints final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  static int corners_within(const Piece& own, const Piece& other) {
    int count = 0;
    for (std::uint32_t i = 0; i < own.size(); ++i) {
      bool within = true;
      for (std::uint32_t side = 0; side < other.size(); ++side)
        within = within && other.depth(side, own.at(i)) > 0;
      count += within ? 1 : 0;
    }
    return count;
  }
  double pressure(const Seen& seen) const override {
    const int count =
        corners_within(seen.first[0], seen.first[1]) + corners_within(seen.first[1], seen.first[0]);
    return (1 - 1e-3 * count) * seen.stiffness * seen.area;
  }
};

constexpr talus::Component components[] = {area_law<KicksAtJoints>("kicks_at_joints", 0)};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
