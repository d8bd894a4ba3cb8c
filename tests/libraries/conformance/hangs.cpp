// Waits for a coordinate to become a number.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class Hangs final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  void begin(const ContactBatch& batch, const ContactLoads& /*loads*/) const override {
    for (std::uint32_t k = 0; k < batch.active_count; ++k) {
      const talus::PiecePair pieces = batch.piece_pairs.at(batch.pairs[batch.active[k]], 0);
      const volatile double& x = batch.boundaries.corner[batch.boundaries.piece_start[pieces.b]].x;
      while (std::isnan(x)) {
      }
    }
  }
};

constexpr talus::Component components[] = {area_law<Hangs>("hangs")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
