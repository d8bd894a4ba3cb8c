// Stiffer by a millionth for each square metre of distance that the bodies have come.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class DependsOnPlace final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  static double way(const Piece& piece, Point offset) {
    talus::overlap::Polygon ring;
    ring.make_room(piece.size());
    for (std::uint32_t i = 0; i < piece.size(); ++i) ring.append({piece.at(i) - offset, {0, i}});
    const Point centre = area_centroid(ring).centroid;
    return dot(centre, centre);
  }
  double pressure(const Seen& seen) const override {
    const Point offset{seen.pair->offset_x, seen.pair->offset_y};
    return (1 + 1e-6 * (way(seen.first[0], {0, 0}) + way(seen.first[1], offset))) * seen.stiffness *
           seen.area;
  }
};

constexpr talus::Component components[] = {area_law<DependsOnPlace>("depends_on_place", 0)};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
