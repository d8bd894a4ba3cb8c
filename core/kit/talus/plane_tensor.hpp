#pragma once

// Tensors of the plane for constitutive laws: rotation, the midpoint step of a rate form, stress measures and
// isotropic elasticity. Header only, on the standard library alone.

#include <cstddef>

namespace talus {

/// A symmetric tensor: stress, Pa, or strain (xy is half of the engineering shear strain).
struct PlaneTensor {
  double xx = 0, yy = 0, xy = 0;
};

constexpr PlaneTensor operator+(const PlaneTensor& p, const PlaneTensor& q) {
  return {p.xx + q.xx, p.yy + q.yy, p.xy + q.xy};
}

constexpr PlaneTensor operator-(const PlaneTensor& p, const PlaneTensor& q) {
  return {p.xx - q.xx, p.yy - q.yy, p.xy - q.xy};
}

constexpr PlaneTensor operator*(double factor, const PlaneTensor& p) {
  return {factor * p.xx, factor * p.yy, factor * p.xy};
}

/// p : q.
constexpr double contraction(const PlaneTensor& p, const PlaneTensor& q) {
  return p.xx * q.xx + p.yy * q.yy + 2 * p.xy * q.xy;
}

/// A tensor between reference and current configuration: the deformation gradient F, or the first
/// Piola–Kirchhoff stress P, Pa.
struct TwoPointTensor {
  double xx = 1, xy = 0, yx = 0, yy = 1;
};

/// The tensor of element i of four arrays in the order of MaterialBatch.
inline TwoPointTensor tensor_at(const double* const components[4], std::size_t i) {
  return {components[0][i], components[1][i], components[2][i], components[3][i]};
}

/// The other way.
inline void write(const TwoPointTensor& tensor, double* const components[4], std::size_t i) {
  components[0][i] = tensor.xx;
  components[1][i] = tensor.xy;
  components[2][i] = tensor.yx;
  components[3][i] = tensor.yy;
}

constexpr double determinant(const TwoPointTensor& f) {
  return f.xx * f.yy - f.xy * f.yx;
}

/// Cosine and sine of the angle of a rotation Q.
struct PlaneRotation {
  double cosine = 1, sine = 0;
};

/// Q t Qᵀ: the tensor carried along by the rotation.
constexpr PlaneTensor rotated(const PlaneRotation& q, const PlaneTensor& t) {
  const double cc = q.cosine * q.cosine, ss = q.sine * q.sine, cs = q.cosine * q.sine;
  return {cc * t.xx + ss * t.yy - 2 * cs * t.xy, ss * t.xx + cc * t.yy + 2 * cs * t.xy,
          cs * (t.xx - t.yy) + (cc - ss) * t.xy};
}

/// The same by half the angle, of which it needs only the double.
constexpr PlaneTensor rotated_by_half(const PlaneTensor& t, const PlaneRotation& q) {
  const double mean = (t.xx + t.yy) / 2, half = (t.xx - t.yy) / 2;
  const double along = q.cosine * half - q.sine * t.xy, across = q.sine * half + q.cosine * t.xy;
  return {mean + along, mean - along, across};
}

/// What the material does between two configurations.
struct MidpointStep {
  PlaneTensor strain;  ///< in the directions of the end of the step
  PlaneRotation rotation;
};

/// Strain increment and rotation by Hughes and Winget: the displacement increment by its gradient in the
/// midpoint configuration, ΔL = ΔF (½(F_n + F_{n-1}))⁻¹, strain its symmetric part (Eq. 3), rotation
/// (I − ½W)⁻¹(I + ½W) of its skew part W. A rotation by any angle short of half a turn gives no strain and
/// exactly that rotation. The strain belongs to the midpoint, so it is carried along for the second half of
/// the rotation (Eq. 7 with R of the midpoint, then of the end): without that, stress lags by half a step's
/// turn.
constexpr MidpointStep midpoint_step(const TwoPointTensor& before, const TwoPointTensor& now) {
  const TwoPointTensor middle{(before.xx + now.xx) / 2, (before.xy + now.xy) / 2, (before.yx + now.yx) / 2,
                              (before.yy + now.yy) / 2};
  const TwoPointTensor change{now.xx - before.xx, now.xy - before.xy, now.yx - before.yx, now.yy - before.yy};
  const double volume = determinant(middle);
  const double xx = (change.xx * middle.yy - change.xy * middle.yx) / volume;
  const double xy = (change.xy * middle.xx - change.xx * middle.xy) / volume;
  const double yx = (change.yx * middle.yy - change.yy * middle.yx) / volume;
  const double yy = (change.yy * middle.xx - change.yx * middle.xy) / volume;
  const double half_tangent = (yx - xy) / 4;  // tan of half the angle, since W = 2 tan(θ/2)
  const double square = half_tangent * half_tangent;
  const PlaneRotation rotation{(1 - square) / (1 + square), 2 * half_tangent / (1 + square)};
  return {rotated_by_half({xx, yy, (xy + yx) / 2}, rotation), rotation};
}

/// P = det F σ F⁻ᵀ of a Cauchy stress σ.
constexpr TwoPointTensor first_piola(const PlaneTensor& cauchy, const TwoPointTensor& f) {
  return {cauchy.xx * f.yy - cauchy.xy * f.xy, cauchy.xy * f.xx - cauchy.xx * f.yx,
          cauchy.xy * f.yy - cauchy.yy * f.xy, cauchy.yy * f.xx - cauchy.xy * f.yx};
}

/// ½ (P_{n-1} + P_n) : (F_n − F_{n-1}), J/m³ of reference volume: what an element takes from the motion when
/// that is stepped by central differences (Eqs. 22–24), exactly. Both stresses are Cauchy stresses.
constexpr double stress_work(const PlaneTensor& stress_before, const TwoPointTensor& before,
                             const PlaneTensor& stress_now, const TwoPointTensor& now) {
  const TwoPointTensor p = first_piola(stress_before, before), q = first_piola(stress_now, now);
  return ((p.xx + q.xx) * (now.xx - before.xx) + (p.xy + q.xy) * (now.xy - before.xy) +
          (p.yx + q.yx) * (now.yx - before.yx) + (p.yy + q.yy) * (now.yy - before.yy)) /
         2;
}

/// Isotropic elasticity of the plane, Pa: D_11 = D_22, D_12 and D_33 = G (Eq. 2).
struct PlaneModuli {
  double along = 0, across = 0, shear = 0;
};

constexpr PlaneModuli plane_strain_moduli(double young, double poisson) {
  const double factor = young / ((1 + poisson) * (1 - 2 * poisson));
  return {factor * (1 - poisson), factor * poisson, young / (2 * (1 + poisson))};
}

constexpr PlaneModuli plane_stress_moduli(double young, double poisson) {
  const double along = young / (1 - poisson * poisson);
  return {along, poisson * along, young / (2 * (1 + poisson))};
}

/// D : ε.
constexpr PlaneTensor operator*(const PlaneModuli& d, const PlaneTensor& strain) {
  return {d.along * strain.xx + d.across * strain.yy, d.across * strain.xx + d.along * strain.yy,
          2 * d.shear * strain.xy};
}

/// As Material::stiffest_tangent wants it.
constexpr void write_tangent(const PlaneModuli& d, double tangent[9]) {
  const double values[9] = {d.along, d.across, 0, d.across, d.along, 0, 0, 0, d.shear};
  for (int i = 0; i < 9; ++i) tangent[i] = values[i];
}

}  // namespace talus
