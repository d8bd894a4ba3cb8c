// The material my_component. See README.md beside.

#include <talus/library.hpp>
#include <talus/plane_tensor.hpp>

namespace {

constexpr talus::Parameter parameters[] = {
    talus::number("young_modulus", "Pa", talus::required, 1e-300, talus::unbounded, "Young's modulus E."),
    talus::number("poisson_ratio", "-", talus::required, 0, 0.499, "Poisson's ratio ν."),
};

class MyComponent final : public talus::Material {
 public:
  explicit MyComponent(const double* values) : moduli_(talus::plane_strain_moduli(values[0], values[1])) {}

  std::uint32_t doubles_per_element() const noexcept override { return 0; }

  void evaluate(const talus::MaterialBatch& batch,
                const talus::MaterialResponse& response) const noexcept override {
    for (std::uint32_t i = 0; i < batch.count; ++i) {
      const talus::TwoPointTensor f = talus::tensor_at(batch.deformation, i);
      // ---- the law: these lines are yours
      // -------------------------------------------------------------------- Green's strain E = (FᵀF − I)/2,
      // second Piola–Kirchhoff stress S = D E, energy E : S / 2 per reference volume
      const talus::PlaneTensor strain{(f.xx * f.xx + f.yx * f.yx - 1) / 2,
                                      (f.xy * f.xy + f.yy * f.yy - 1) / 2, (f.xx * f.xy + f.yx * f.yy) / 2};
      const talus::PlaneTensor stress = moduli_ * strain;
      const double energy = talus::contraction(strain, stress) / 2;
      // ---- the rest: P = F S, and nothing is dissipated
      // ------------------------------------------------------------
      response.stress[0][i] = f.xx * stress.xx + f.xy * stress.xy;
      response.stress[1][i] = f.xx * stress.xy + f.xy * stress.yy;
      response.stress[2][i] = f.yx * stress.xx + f.yy * stress.xy;
      response.stress[3][i] = f.yx * stress.xy + f.yy * stress.yy;
      response.energy[i] = energy;
      response.dissipated[i] = 0;
    }
  }

  void stiffest_tangent(double tangent[9]) const noexcept override { talus::write_tangent(moduli_, tangent); }

  bool needs_previous_deformation() const noexcept override { return false; }

 private:
  talus::PlaneModuli moduli_;
};

constexpr talus::Component components[] = {talus::material<MyComponent>(
    "my_component", "Isotropic, stress proportional to Green's strain, plane strain.", parameters,
    talus::trait::has_potential)};

}  // namespace

TALUS_EXPORT const talus::Library talus_library =
    talus::library("my_component", "0.1.0", "its author", components);
