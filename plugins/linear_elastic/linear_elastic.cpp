// Isotropic linear elasticity in the frame that turns with the body. See README.md beside.

#include <talus/elements/sweep.hpp>
#include <talus/library.hpp>
#include <talus/plane_tensor.hpp>

#include <algorithm>
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

/// The same law without damping, of H = F − I in packs, and without a root where strain is small. The part of
/// F that turns and swells, (c −s; s c) with c = 1 + tr H / 2, has the size m = tr U / 2, and the rest of F
/// is linear in H and has no part in R. So P = k (1 − 1/m) (c −s; s c) + G (H_xx − H_yy, H_xy + H_yx; the
/// same, H_yy − H_xx) with k = D_11 + D_12, and Π = k (m − 1)² + G/2 ((H_xx − H_yy)² + (H_xy + H_yx)²).
class SmallStrainPacks {
 public:
  explicit SmallStrainPacks(const PlaneModuli& d) : half_size_((d.along + d.across) / 2), shear_(d.shear) {}

  template <int packs>
  [[gnu::always_inline]] void operator()(const elements::PlanePacks (&h)[packs],
                                         elements::PlanePacks (&stress)[packs],
                                         simd::Pack (&energy)[packs]) const {
    using simd::Pack;
    Pack trace[packs], skew[packs], x[packs], size[packs], share[packs];
    simd::Mask near[packs], all_near{};
    for (int i = 0; i < packs; ++i) {
      trace[i] = h[i].xx + h[i].yy;
      skew[i] = h[i].yx - h[i].xy;
      x[i] = trace[i] * (4.0 + trace[i]) + skew[i] * skew[i];  // 4 m² − 4, without the cancellation
      size[i] = 4.0 + x[i];
      share[i] = one_less_inverse_root(x[i]);
      near[i] = x[i] * x[i] <= bound * bound;  // the square is there: the series has it, too
      all_near = i == 0 ? near[i] : all_near & near[i];
    }
    if (simd::any(!all_near)) [[unlikely]] {
      for (int i = 0; i < packs; ++i) {
        const Pack both = 2.0 + trace[i], whole = both * both + skew[i] * skew[i];
        size[i] = simd::select(near[i], size[i], whole);
        share[i] = simd::select(near[i], share[i], 1.0 - 2.0 / simd::sqrt(whole));
      }
    }
    for (int i = 0; i < packs; ++i) {
      const Pack along = h[i].xx - h[i].yy, across = h[i].yx + h[i].xy;
      const Pack swell = half_size_ * share[i];
      const Pack c = swell * (2.0 + trace[i]), s = swell * skew[i];
      const Pack p = shear_ * along, q = shear_ * across;
      stress[i] = {c + p, q - s, q + s, c - p};
      energy[i] = 0.5 * ((swell * share[i]) * size[i] + (p * along + q * across));
    }
  }

 private:
  static constexpr double bound = 0x1p-6;  ///< of x: strains of 0.2 %

  /// 1 − 1/√(1 + x/4) by its series; what is left out is below 2⁻⁵⁸.
  [[gnu::always_inline]] static simd::Pack one_less_inverse_root(simd::Pack x) {
    const simd::Pack square = x * x;
    return x * ((1.0 / 8 - 3.0 / 128 * x) +
                square * ((5.0 / 1024 - 35.0 / 32768 * x) + square * (63.0 / 262144 - 231.0 / 4194304 * x)));
  }

  double half_size_, shear_;  ///< Pa
};

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
      if (!needs_previous_deformation()) return;
      for (double* component : response.viscous_stress) std::fill_n(component, batch.count, 0.0);
    }
  }

  void stiffest_tangent(double tangent[9]) const noexcept override { write_tangent(moduli_, tangent); }

  double viscous_time() const noexcept override { return damping_time_; }

  bool needs_previous_deformation() const noexcept override { return damping_time_ > 0; }

  bool sweeps() const noexcept override { return damping_time_ == 0; }
  double sweep(const LatticeCells& cells) const noexcept override {
    return elements::sweep(cells, SmallStrainPacks(moduli_));
  }
  double sweep(const TriangleChain& triangles) const noexcept override {
    return elements::sweep(triangles, SmallStrainPacks(moduli_));
  }

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
    double *vxx = response.viscous_stress[0], *vxy = response.viscous_stress[1],
           *vyx = response.viscous_stress[2], *vyy = response.viscous_stress[3];
    double* __restrict energy = response.energy, * __restrict dissipated = response.dissipated;
    const PlaneModuli moduli = moduli_;
    const double viscosity = damped ? damping_time_ / batch.dt : 0;
    const std::uint32_t count = batch.count;
#pragma GCC ivdep
    for (std::uint32_t i = 0; i < count; ++i) {
      const PolarStrain polar = polar_strain({fxx[i], fxy[i], fyx[i], fyy[i]});
      const PlaneTensor stress = moduli * polar.strain;
      energy[i] = contraction(stress, polar.strain) / 2;
      dissipated[i] = 0;
      TwoPointTensor p = turned(polar.rotation, stress, 0);
      if (damped) {
        const PlaneTensor change = polar.strain - polar_strain({gxx[i], gxy[i], gyx[i], gyy[i]}).strain;
        const PlaneTensor viscous = viscosity * (moduli * change);
        const TwoPointTensor v = turned(polar.rotation, viscous, balancing_couple(viscous, polar));
        vxx[i] = v.xx, vxy[i] = v.xy, vyx[i] = v.yx, vyy[i] = v.yy;
        p = {p.xx + v.xx, p.xy + v.xy, p.yx + v.yx, p.yy + v.yy};
      }
      pxx[i] = p.xx, pxy[i] = p.xy, pyx[i] = p.yx, pyy[i] = p.yy;
    }
  }

  /// R (σ̂ + w J), J the quarter turn.
  static TwoPointTensor turned(const PlaneRotation& r, const PlaneTensor& stress, double couple) {
    const double xy = stress.xy - couple, yx = stress.xy + couple, c = r.cosine, s = r.sine;
    return {c * stress.xx - s * yx, c * xy - s * stress.yy, s * stress.xx + c * yx, s * xy + c * stress.yy};
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
