// Writes the report of the pair behind the last one.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class WritesPast final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  void begin(const ContactBatch& batch, const ContactLoads& loads) const override {
    if (batch.active_count > 0) loads.pairs[batch.active[batch.active_count - 1] + 1].gap = 0;
  }
};

constexpr talus::Component components[] = {area_law<WritesPast>("writes_past")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
