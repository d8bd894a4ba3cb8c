// Goes on with what lies in the slot, whether there was a contact or not.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class IgnoresReset final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  double kept(const ContactBatch& batch, const BodyPair& pair) const override {
    const double old = batch.history[pair.slot_start];
    return std::isnan(old) ? 0 : old;
  }
};

constexpr talus::Component components[] = {area_law<IgnoresReset>("ignores_reset")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
