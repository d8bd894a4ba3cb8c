#pragma once

// The small law with dashpots across the contact, right in every respect.

#include "area_law.hpp"

namespace spoilt {

inline constexpr talus::Parameter damped_parameters[] = {
    interface_parameters[0], interface_parameters[1], interface_parameters[2],
    talus::number("normal_damping", "-", 0, 0, 10, "Pressure per rate of approach, 1e5 Pa s/m.")};

class DampedLaw : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

  talus::ContactStiffness stiffness(const double* values, double length) const noexcept override {
    talus::ContactStiffness all = AreaLaw::stiffness(values, length);
    all.normal_damping_ratio = values[3] * length;
    return all;
  }

 protected:
  virtual double told_power(double power) const { return power; }
  virtual double told_force(double force) const { return force; }

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
    const double force = viscous(seen) * length(seen.outward);
    report.damping_power = told_power(force * approach(seen) * seen.batch->dt);
    report.damping_force = static_cast<float>(told_force(std::fabs(force)));
  }
};

template <class Law>
constexpr talus::Component damped_law(const char* name) {
  return talus::contact_model<Law>(name, "A law for tests.", {}, damped_parameters,
                                   talus::trait::has_potential);
}

}  // namespace spoilt
