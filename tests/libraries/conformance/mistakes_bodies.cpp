// Takes the number of a plain body for that of its piece.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class MistakesBodies final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  double slip_velocity(const Seen& seen) const override {
    if (!seen.pair->plain()) return AreaLaw::slip_velocity(seen);
    const talus::Boundaries& boundaries = seen.batch->boundaries;
    const Piece a(boundaries, seen.pair->a, {0, 0}, 0),
        b(boundaries, seen.pair->b, {seen.pair->offset_x, seen.pair->offset_y}, 0);
    return b.working_velocity(seen.longest_side[1], seen.centre, seen.tangent) -
           a.working_velocity(seen.longest_side[0], seen.centre, seen.tangent);
  }
};

constexpr talus::Component components[] = {area_law<MistakesBodies>("mistakes_bodies")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
