// Damps, and says what power that takes, but not the force.
#include "area_law.hpp"

namespace {

using namespace spoilt;

constexpr talus::Parameter damped_parameters[] = {
    interface_parameters[0], interface_parameters[1], interface_parameters[2],
    talus::number("normal_damping", "-", 0, 0, 10, "Pressure per rate of approach, 1e5 Pa s/m.")};

class HidesDashpots final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

  talus::ContactStiffness stiffness(const double* values, double length) const noexcept override {
    talus::ContactStiffness all = AreaLaw::stiffness(values, length);
    all.normal_damping_ratio = values[3] * length;
    return all;
  }

 private:
  static double approach(const Seen& seen) {
    return dot(mean_velocity(seen.first[0]) - mean_velocity(seen.first[1]), seen.normal);
  }
  double viscous(const Seen& seen) const {
    const talus::Interfaces& interfaces = seen.batch->interfaces;
    const double ratio = interfaces.value[row(interfaces) * interfaces.parameter_count + 3];
    return std::fmax(1e5 * ratio * approach(seen), -AreaLaw::pressure(seen));
  }
  double pressure(const Seen& seen) const override { return AreaLaw::pressure(seen) + viscous(seen); }
  double stored(const Seen& seen, double /*energy*/) const override {
    return AreaLaw::pressure(seen) * seen.area / 2;
  }
  void tell_dashpots(const Seen& seen, talus::PairReport& report) const override {
    report.damping_power = viscous(seen) * length(seen.outward) * approach(seen) * seen.batch->dt;
  }
};

constexpr talus::Component components[] = {
    talus::contact_model<HidesDashpots>("hides_dashpots", "A law for tests.", {}, damped_parameters)};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
