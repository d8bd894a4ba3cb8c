// Works on large batches eight by eight, past the last element.
#include "elastic_rock.hpp"

namespace {

using namespace spoilt;

class WorksInEights final : public ElasticRock {
 public:
  using ElasticRock::ElasticRock;

 private:
  std::uint32_t count_of(const talus::MaterialBatch& batch) const override {
    return batch.count < 150 ? batch.count : (batch.count + 7) / 8 * 8;
  }
};

constexpr talus::Component components[] = {rock<WorksInEights>("works_in_eights")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
