// Calls a function that nobody defines; linked carelessly, it fails only when it is loaded.
#include "descriptor.hpp"

extern "C" double defined_nowhere(double value);

namespace {

class CarelessLaw final : public SilentLaw {
 public:
  explicit CarelessLaw(const double* values) : SilentLaw(values), value_(defined_nowhere(1)) {}
  talus::ContactStiffness stiffness(const double*, double) const noexcept override {
    return {value_, 0, 0, 0};
  }

 private:
  double value_;
};

constexpr talus::Component components[] = {law<CarelessLaw>("undefined_symbol")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = descriptor(components, 1);
