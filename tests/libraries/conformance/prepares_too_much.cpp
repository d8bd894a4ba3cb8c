// Prepares one value more than it has declared.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class PreparesTooMuch final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

  void prepare_interface(double* values) const noexcept override {
    AreaLaw::prepare_interface(values);
    values[3] = 1;
  }
};

constexpr talus::Component components[] = {area_law<PreparesTooMuch>("prepares_too_much")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
