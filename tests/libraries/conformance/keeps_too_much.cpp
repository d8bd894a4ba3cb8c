// Keeps more for each element than the program has room for.
#include "elastic_rock.hpp"

#include <algorithm>

namespace {

using namespace spoilt;

class KeepsTooMuch final : public ElasticRock {
 public:
  using ElasticRock::ElasticRock;

  std::uint32_t doubles_per_element() const noexcept override { return 4097; }

  void evaluate(const talus::MaterialBatch& batch,
                const talus::MaterialResponse& response) const noexcept override {
    ElasticRock::evaluate(batch, response);
    std::fill_n(response.state, std::size_t{batch.count} * doubles_per_element(), 0.0);
  }
};

constexpr talus::Component components[] = {rock<KeepsTooMuch>("keeps_too_much")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
