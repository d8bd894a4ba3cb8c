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
[[gnu::always_inline]] inline PolarStrain polar_strain(const TwoPointTensor& f) {
  const double trace = f.xx + f.yy, skew = f.yx - f.xy;
  const double size = std::sqrt(trace * trace + skew * skew);
  const double inverse = 1 / size, c = trace * inverse, s = skew * inverse;
  // U is symmetric: −s F_xx + c F_yx is the same as what stands for xy.
  return {{c, s}, size, {c * f.xx + s * f.yx - 1, -s * f.xy + c * f.yy - 1, c * f.xy + s * f.yy}};
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
    if (needs_previous_deformation() && batch.dt > 0) {
      respond<true>(batch, response);
    } else {
      respond<false>(batch, response);
    }
  }

  void stiffest_tangent(double tangent[9]) const noexcept override { write_tangent(moduli_, tangent); }

  double viscous_time() const noexcept override { return damping_time_; }

  bool needs_previous_deformation() const noexcept override { return damping_time_ > 0; }

 private:
  /// No branch within, and the arrays are apart (ivdep): the loop becomes one over vectors.
  template <bool damped>
  void respond(const MaterialBatch& batch, const MaterialResponse& response) const noexcept {
    const double *fxx = batch.deformation[0], *fxy = batch.deformation[1], *fyx = batch.deformation[2],
                 *fyy = batch.deformation[3];
    const double *gxx = batch.previous_deformation[0], *gxy = batch.previous_deformation[1],
                 *gyx = batch.previous_deformation[2], *gyy = batch.previous_deformation[3];
    double *pxx = response.stress[0], *pxy = response.stress[1], *pyx = response.stress[2],
           *pyy = response.stress[3];
    double* __restrict energy = response.energy, * __restrict dissipated = response.dissipated;
    const PlaneModuli moduli = moduli_;
    const double viscosity = damped ? damping_time_ / batch.dt : 0;
    const std::uint32_t count = batch.count;
#pragma GCC ivdep
    for (std::uint32_t i = 0; i < count; ++i) {
      const PolarStrain polar = polar_strain({fxx[i], fxy[i], fyx[i], fyy[i]});
      PlaneTensor stress = moduli * polar.strain;
      energy[i] = contraction(stress, polar.strain) / 2;
      dissipated[i] = 0;
      double couple = 0;
      if (damped) {
        const PlaneTensor change = polar.strain - polar_strain({gxx[i], gxy[i], gyx[i], gyy[i]}).strain;
        const PlaneTensor viscous = viscosity * (moduli * change);
        stress = stress + viscous;
        couple = balancing_couple(viscous, polar);
        dissipated[i] = contraction(viscous, change);
      }
      const double c = polar.rotation.cosine, s = polar.rotation.sine;
      const double xy = stress.xy - couple, yx = stress.xy + couple;
      pxx[i] = c * stress.xx - s * yx;
      pxy[i] = c * xy - s * stress.yy;
      pyx[i] = s * stress.xx + c * yx;
      pyy[i] = s * xy + c * stress.yy;
    }
  }

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
    "linear_elastic", "Isotropic linear elasticity, corotational: exact under any rotation.", parameters,
    trait::has_potential)};

}  // namespace

TALUS_EXPORT const talus::Library talus_library =
    talus::library("linear_elastic", "0.1.0", "the talus authors", components);
