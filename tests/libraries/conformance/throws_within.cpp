// Throws at a coordinate that is no number, where nothing may be thrown.
#include "area_law.hpp"

#include <stdexcept>

namespace {

using namespace spoilt;

class ThrowsWithin final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  void begin(const ContactBatch& batch, const ContactLoads& /*loads*/) const override {
    for (std::uint32_t k = 0; k < batch.active_count; ++k) {
      const talus::PiecePair pieces = batch.piece_pairs.at(batch.pairs[batch.active[k]], 0);
      if (std::isnan(batch.boundaries.corner[batch.boundaries.piece_start[pieces.b]].x))
        throw std::runtime_error("no place for this corner");
    }
  }
};

constexpr talus::Component components[] = {area_law<ThrowsWithin>("throws_within")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
