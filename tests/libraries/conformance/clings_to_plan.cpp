// Takes the time step of the first call with a plan for that of all.
#include "area_law.hpp"

namespace {

using namespace spoilt;

struct FirstStep final : talus::BatchPlan {
  double dt = 0;
};

class ClingsToPlan final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

  talus::BatchPlan* make_plan() const noexcept override { return new FirstStep; }

 private:
  double time_step(const ContactBatch& batch) const override {
    if (batch.plan == nullptr) return batch.dt;
    auto& first = static_cast<FirstStep&>(*batch.plan);
    if (first.dt == 0) first.dt = batch.dt;
    return first.dt;
  }
};

constexpr talus::Component components[] = {area_law<ClingsToPlan>("clings_to_plan")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
