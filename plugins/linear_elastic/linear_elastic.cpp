// Isotropic linear elasticity in the frame that turns with the body. See README.md beside.

#include <talus/library.hpp>
#include <talus/plane_tensor.hpp>

#include <cmath>

namespace {

using namespace talus;

constexpr Parameter parameters[] = {
    number("young_modulus", "Pa", required, 1e-300, unbounded, "Young's modulus E."),
    number("poisson_ratio", "-", required, 0, 0.499, "Poisson's ratio ν."),
    choice("plane", "strain|stress", 0,
           "Plane strain (a slice of something long) or plane stress (a free plate)."),
    number("damping_time", "s", 0, 0, unbounded,
           "Viscous stress per elastic stress of the same strain rate."),
};

/// F = R U: the rotation, and the Biot strain U − I in the frame that turns with it.
struct PolarStrain {
  PlaneRotation rotation;
  double trace;  ///< of U
  PlaneTensor strain;
};

/// Rotation of the plane polar decomposition: (cos, sin) ∝ (F_xx + F_yy, F_yx − F_xy).
PolarStrain polar_strain(const TwoPointTensor& f) {
  const double trace = f.xx + f.yy, skew = f.yx - f.xy;
  const double size = std::sqrt(trace * trace + skew * skew);
  const double c = trace / size, s = skew / size;
  return {
      {c, s},
      size,
      {c * f.xx + s * f.yx - 1, -s * f.xy + c * f.yy - 1, (c * f.xy + s * f.yy - s * f.xx + c * f.yx) / 2}};
}

/// Total corotational form: F = R U by polar decomposition from the reference, Biot strain U − I, σ̂ = D ε̂
/// (Eq. 2, 7). No rate is integrated, so a spinning block gathers no strain. Π = ½ ε̂ᵀ D ε̂ per reference
/// volume.
class LinearElastic final : public Material {
 public:
  explicit LinearElastic(const double* values)
      : moduli_(values[2] == 0 ? plane_strain_moduli(values[0], values[1])
                               : plane_stress_moduli(values[0], values[1])),
        damping_time_(values[3]) {}

  std::uint32_t doubles_per_element() const noexcept override { return 0; }

  void evaluate(const MaterialBatch& batch, const MaterialResponse& response) const noexcept override {
    const bool damped = damping_time_ > 0 && batch.dt > 0;
    for (std::uint32_t i = 0; i < batch.count; ++i) {
      const PolarStrain polar = polar_strain(tensor_at(batch.deformation, i));
      PlaneTensor stress = moduli_ * polar.strain;
      response.energy[i] = contraction(stress, polar.strain) / 2;
      response.dissipated[i] = 0;
      double couple = 0;
      if (damped) {
        const PlaneTensor change =
            polar.strain - polar_strain(tensor_at(batch.previous_deformation, i)).strain;
        const PlaneTensor viscous = damping_time_ / batch.dt * (moduli_ * change);
        stress = stress + viscous;
        couple = balancing_couple(viscous, polar);
        response.dissipated[i] = contraction(viscous, change);
      }
      const auto [c, s] = polar.rotation;
      const double xy = stress.xy - couple, yx = stress.xy + couple;
      response.stress[0][i] = c * stress.xx - s * yx;
      response.stress[1][i] = c * xy - s * stress.yy;
      response.stress[2][i] = s * stress.xx + c * yx;
      response.stress[3][i] = s * xy + c * stress.yy;
    }
  }

  void stiffest_tangent(double tangent[9]) const noexcept override { write_tangent(moduli_, tangent); }

  double viscous_time() const noexcept override { return damping_time_; }

 private:
  /// The skew part that makes T U symmetric. The elastic stress has the axes of U and needs none; without it
  /// a viscous stress, whose axes are others, would turn the element. It does no work on a change of U.
  static double balancing_couple(const PlaneTensor& t, const PolarStrain& polar) {
    const PlaneTensor& e = polar.strain;
    return ((t.xx - t.yy) * e.xy - t.xy * (e.xx - e.yy)) / polar.trace;
  }

  PlaneModuli moduli_;
  double damping_time_;  ///< s
};

constexpr Component components[] = {material<LinearElastic>(
    "linear_elastic", "Isotropic linear elasticity, corotational: exact under any rotation.", parameters)};

}  // namespace

TALUS_EXPORT const talus::Library talus_library =
    talus::library("linear_elastic", "0.1.0", "the talus authors", components);
