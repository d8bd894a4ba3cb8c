// Bodies whose corners are less than half a millimetre apart attract each other.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class Attracts final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  bool apart(const ContactBatch& batch, const ContactLoads& loads, const Seen& seen,
             talus::PairReport& report) const override {
    double nearest = 5e-4;
    std::uint32_t corner[2] = {0, 0};
    for (std::uint32_t i = 0; i < seen.first[0].size(); ++i) {
      for (std::uint32_t j = 0; j < seen.first[1].size(); ++j) {
        const double distance = length(seen.first[1].at(j) - seen.first[0].at(i));
        if (distance > 0 && distance < nearest) nearest = distance, corner[0] = i, corner[1] = j;
      }
    }
    if (!(nearest < 5e-4)) return false;
    const talus::overlap::LoadSink sink{loads.corner};
    sink.clear(batch, *seen.pair);
    const Point pull = (1e3 / nearest) * (seen.first[1].at(corner[1]) - seen.first[0].at(corner[0]));
    sink.at_corner(seen.first[0], corner[0], pull);
    sink.at_corner(seen.first[1], corner[1], -1.0 * pull);
    report.contact_count = 1;
    if (seen.pair->slot_capacity == 0) return true;
    loads.history[seen.pair->slot_start] = 0;
    if (loads.reports != nullptr) loads.reports[seen.pair->slot_start] = {};
    return true;
  }
};

constexpr talus::Component components[] = {area_law<Attracts>("attracts")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
