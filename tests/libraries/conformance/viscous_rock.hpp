#pragma once

// A small viscous material that is right in every respect, for others to spoil in one: linear in Green's
// strain and in its rate.

#include <talus/library.hpp>
#include <talus/plane_tensor.hpp>

namespace spoilt {

inline constexpr talus::Parameter viscous_parameters[] = {
    talus::number("young_modulus", "Pa", talus::required, 1e-300, talus::unbounded, "Young's modulus E."),
    talus::number("damping_time", "s", 0, 0, talus::unbounded,
                  "Viscous stress per elastic stress of the same strain rate."),
};

class ViscousRock : public talus::Material {
 public:
  explicit ViscousRock(const double* values)
      : moduli_(talus::plane_strain_moduli(values[0], 0.2)), damping_time_(values[1]) {}

  std::uint32_t doubles_per_element() const noexcept override { return 0; }

  void evaluate(const talus::MaterialBatch& batch,
                const talus::MaterialResponse& response) const noexcept override {
    const double viscosity = batch.dt > 0 ? damping_time_ / batch.dt : 0;
    for (std::uint32_t i = 0; i < batch.count; ++i) {
      const talus::TwoPointTensor f = talus::tensor_at(batch.deformation, i);
      const talus::PlaneTensor strain = green(f),
                               change = strain - green(talus::tensor_at(batch.previous_deformation, i));
      const talus::PlaneTensor elastic = moduli_ * strain, viscous = viscosity * (moduli_ * change);
      talus::write(forward(f, elastic + viscous), response.stress, i);
      talus::write(forward(f, told_share() * viscous), response.viscous_stress, i);
      response.energy[i] = talus::contraction(elastic, strain) / 2;
      response.dissipated[i] = told_loss(talus::contraction(viscous, change));
    }
  }

  void stiffest_tangent(double tangent[9]) const noexcept override { talus::write_tangent(moduli_, tangent); }
  double viscous_time() const noexcept override { return damping_time_; }

 protected:
  virtual double told_share() const { return 1; }  ///< of viscous stress
  virtual double told_loss(double /*viscous*/) const { return 0; }

 private:
  /// P = F S.
  static talus::TwoPointTensor forward(const talus::TwoPointTensor& f, const talus::PlaneTensor& s) {
    return {f.xx * s.xx + f.xy * s.xy, f.xx * s.xy + f.xy * s.yy, f.yx * s.xx + f.yy * s.xy,
            f.yx * s.xy + f.yy * s.yy};
  }
  static talus::PlaneTensor green(const talus::TwoPointTensor& f) {
    return {(f.xx * f.xx + f.yx * f.yx - 1) / 2, (f.xy * f.xy + f.yy * f.yy - 1) / 2,
            (f.xx * f.xy + f.yx * f.yy) / 2};
  }

  talus::PlaneModuli moduli_;
  double damping_time_;  ///< s
};

template <class Rock>
constexpr talus::Component viscous_rock(const char* name) {
  return talus::material<Rock>(name, "A material for tests.", viscous_parameters,
                               talus::trait::has_potential);
}

template <std::size_t count>
constexpr talus::Library library(const talus::Component (&components)[count]) {
  return talus::library("spoilt", "1.0", "the tests of talus", components);
}

}  // namespace spoilt
