// Reads the pair behind the last one.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class ReadsPast final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  double pressure(const Seen& seen) const override {
    const ContactBatch& batch = *seen.batch;
    const BodyPair& behind = batch.pairs[batch.active[batch.active_count - 1] + 1];
    return seen.stiffness * seen.area + 0 * behind.reduced_mass;
  }
};

constexpr talus::Component components[] = {area_law<ReadsPast>("reads_past")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
