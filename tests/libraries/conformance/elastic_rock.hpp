#pragma once

// A small material that is right in every respect, for others to spoil in one: linear elasticity in the frame
// that turns with the element. Each virtual function is a place where a material can go wrong.

#include <talus/library.hpp>
#include <talus/plane_tensor.hpp>

#include <cmath>

namespace spoilt {

inline constexpr talus::Parameter rock_parameters[] = {
    talus::number("young_modulus", "Pa", talus::required, 1e-300, talus::unbounded, "Young's modulus E."),
};

class ElasticRock : public talus::Material {
 public:
  explicit ElasticRock(const double* values) : moduli_(talus::plane_strain_moduli(values[0], 0.2)) {}

  std::uint32_t doubles_per_element() const noexcept override { return 0; }
  bool needs_previous_deformation() const noexcept override { return false; }

  void evaluate(const talus::MaterialBatch& batch,
                const talus::MaterialResponse& response) const noexcept override {
    for (std::uint32_t i = 0; i < count_of(batch); ++i) {
      const talus::TwoPointTensor f = talus::tensor_at(batch.deformation, i);
      const talus::PlaneRotation r = rotation_of(f);
      const double c = r.cosine, s = r.sine;
      // Rᵀ F, which is U where R is the rotation of F; the strain is its symmetric part less one.
      const double xx = c * f.xx + s * f.yx, xy = c * f.xy + s * f.yy, yx = -s * f.xx + c * f.yx,
                   yy = -s * f.xy + c * f.yy;
      const talus::PlaneTensor strain{xx - 1, yy - 1, (xy + yx) / 2};
      const talus::PlaneTensor stress = moduli_ * strain;
      response.stress[0][i] = c * stress.xx - s * stress.xy;
      response.stress[1][i] = c * stress.xy - s * stress.yy;
      response.stress[2][i] = s * stress.xx + c * stress.xy;
      response.stress[3][i] = s * stress.xy + c * stress.yy;
      const double stored = talus::contraction(stress, strain) / 2;
      response.energy[i] = energy(stored);
      response.dissipated[i] = 0;
      if (viscous_time() > 0) {
        for (int k = 0; k < 4; ++k) response.viscous_stress[k][i] = viscous(response.stress[k][i]);
      }
    }
  }

  void stiffest_tangent(double tangent[9]) const noexcept override { talus::write_tangent(moduli_, tangent); }

 protected:
  virtual std::uint32_t count_of(const talus::MaterialBatch& batch) const { return batch.count; }
  virtual double energy(double stored) const { return stored; }
  virtual double viscous(double /*stress*/) const { return 0; }
  virtual talus::PlaneRotation rotation_of(const talus::TwoPointTensor& f) const {
    const double trace = f.xx + f.yy, skew = f.yx - f.xy, size = std::hypot(trace, skew);
    return {trace / size, skew / size};
  }

 private:
  talus::PlaneModuli moduli_;
};

template <class Rock>
constexpr talus::Component rock(const char* name, std::uint32_t traits = talus::trait::has_potential) {
  return talus::material<Rock>(name, "A material for tests.", rock_parameters, traits);
}

template <std::size_t count>
constexpr talus::Library library(const talus::Component (&components)[count]) {
  return talus::library("spoilt", "1.0", "the tests of talus", components);
}

}  // namespace spoilt
