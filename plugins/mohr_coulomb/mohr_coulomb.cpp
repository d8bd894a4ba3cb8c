// Elastic, perfectly plastic: Mohr–Coulomb with a tension cut-off, plane strain. See README.md beside.

#include "yield_surface.hpp"

#include <talus/library.hpp>

#include <cstdio>
#include <numbers>
#include <stdexcept>

namespace {

using namespace talus;

constexpr Parameter parameters[] = {
    number("young_modulus", "Pa", required, 1e-300, unbounded, "Young's modulus E."),
    number("poisson_ratio", "-", required, 0, 0.499, "Poisson's ratio ν."),
    number("friction_angle", "deg", required, 0, 89, "Angle of internal friction φ."),
    number("cohesion", "Pa", required, 0, unbounded, "Cohesion c: shear strength without pressure."),
    number("dilation_angle", "deg", 0, 0, 89, "Angle of dilation ψ, at most the friction angle."),
    number("tensile_strength", "Pa", 1e300, 0, unbounded,
           "Tension cut-off; c cot φ, the apex of the shear criterion, where that is less."),
    number("damping_time", "s", 0, 0, unbounded,
           "Viscous stress per elastic stress of the same strain rate."),
};

/// Stress or strain with the component across the plane.
struct SolidTensor {
  PlaneTensor plane;
  double zz = 0;
};

double contraction(const SolidTensor& p, const SolidTensor& q) {
  return contraction(p.plane, q.plane) + p.zz * q.zz;
}

/// Half of p + q.
SolidTensor mean(const SolidTensor& p, const SolidTensor& q) {
  return {0.5 * (p.plane + q.plane), 0.5 * (p.zz + q.zz)};
}

/// The two principal stresses of the plane as a mean and a radius, and the double angle of the larger one.
struct MohrCircle {
  double mean, radius, cosine = 1, sine = 0;

  explicit MohrCircle(const PlaneTensor& t) : mean((t.xx + t.yy) / 2) {
    const double half = (t.xx - t.yy) / 2;
    radius = std::sqrt(half * half + t.xy * t.xy);
    if (radius > 0) {
      cosine = half / radius;
      sine = t.xy / radius;
    }
  }

  /// A tensor with the same directions.
  PlaneTensor with(double larger, double smaller) const {
    const double centre = (larger + smaller) / 2, half = (larger - smaller) / 2;
    return {centre + half * cosine, centre - half * cosine, half * sine};
  }
};

/// Takes a trial stress back to the yield surface; principal directions stay. False if it was within.
bool relax(const YieldSurface& surface, SolidTensor& stress) {
  const MohrCircle circle(stress.plane);
  const double larger = circle.mean + circle.radius, smaller = circle.mean - circle.radius;
  // Where the stress across the plane stands among the three.
  const int zz = stress.zz > larger ? 0 : stress.zz > smaller ? 1 : 2;
  const int first = zz == 0 ? 1 : 0, second = zz == 2 ? 1 : 2;
  Principal principal;
  principal[zz] = stress.zz;
  principal[first] = larger;
  principal[second] = smaller;
  if (surface.yield(principal) <= 0) return false;
  principal = surface.returned(principal);
  stress = {circle.with(principal[first], principal[second]), principal[zz]};
  return true;
}

/// What the host keeps of an element.
struct State {
  SolidTensor stress;  ///< Pa, Cauchy
  double energy = 0;   ///< J/m³ of reference volume: work of the stress less what plastic strain has used up
  double plastic = 0;  ///< accumulated √(⅔ dεᵖ : dεᵖ)

  static constexpr std::uint32_t size = 6;

  static State read(const double* from) { return {{{from[0], from[1], from[2]}, from[3]}, from[4], from[5]}; }
  void write(double* to) const {
    const double values[size] = {stress.plane.xx, stress.plane.yy, stress.plane.xy,
                                 stress.zz,       energy,          plastic};
    for (std::uint32_t k = 0; k < size; ++k) to[k] = values[k];
  }
};

/// The hypoelastic step (Eqs. 2, 7) as trial, then the implicit return to the yield surface.
class MohrCoulomb final : public Material {
 public:
  explicit MohrCoulomb(const double* values)
      : moduli_(plane_strain_moduli(values[0], values[1])),
        surface_(moduli_, checked({values[2], values[3], values[4], values[5]})),
        damping_time_(values[6]) {}

  std::uint32_t doubles_per_element() const noexcept override { return State::size; }

  void evaluate(const MaterialBatch& batch, const MaterialResponse& response) const noexcept override {
    const double viscosity = batch.dt > 0 ? damping_time_ / batch.dt : 0;
    for (std::uint32_t i = 0; i < batch.count; ++i) {
      const TwoPointTensor before = tensor_at(batch.previous_deformation, i);
      const TwoPointTensor now = tensor_at(batch.deformation, i);
      const MidpointStep step = midpoint_step(before, now);
      const PlaneTensor change = moduli_ * step.strain;
      const PlaneTensor viscous = viscosity * change;
      const double volume = determinant(now);

      const State old = State::read(batch.state + std::size_t{State::size} * i);
      const SolidTensor turned{rotated(step.rotation, old.stress.plane), old.stress.zz};
      const double across = moduli_.across * (step.strain.xx + step.strain.yy);
      const SolidTensor trial{turned.plane + change, turned.zz + across};
      State next{trial, old.energy, old.plastic};
      double lost = 0;
      if (relax(surface_, next.stress)) {
        const SolidTensor flow = plastic_strain(trial, next.stress);
        next.plastic += std::sqrt(2.0 / 3.0 * contraction(flow, flow));
        // By the mean stress of the step, as the work is: then the rest is the elastic energy. Only a step
        // that unloads and yields on the other side at once could make it negative.
        const double used = (determinant(before) + volume) / 2 * contraction(mean(turned, next.stress), flow);
        lost = used > 0 ? used : 0;
      }
      next.energy += stress_work(old.stress.plane, before, next.stress.plane, now) - lost;

      write(first_piola(next.stress.plane + viscous, now), response.stress, i);
      if (damping_time_ > 0) write(first_piola(viscous, now), response.viscous_stress, i);
      response.energy[i] = next.energy;
      response.dissipated[i] = lost;
      next.write(response.state + std::size_t{State::size} * i);
    }
  }

  /// Flow only softens it.
  void stiffest_tangent(double tangent[9]) const noexcept override { write_tangent(moduli_, tangent); }

  double viscous_time() const noexcept override { return damping_time_; }

 private:
  static Strength checked(const Strength& strength) {
    constexpr double degrees = 180 / std::numbers::pi;
    char words[200];
    if (strength.dilation_angle > strength.friction_angle) {
      std::snprintf(
          words, sizeof words,
          "dilation_angle is %.12g deg, more than friction_angle, %.12g deg, which would make energy out of "
          "nothing; give at most the friction angle",
          strength.dilation_angle * degrees, strength.friction_angle * degrees);
      throw std::invalid_argument(words);
    }
    if (strength.friction_angle == 0 && strength.cohesion == 0) {
      throw std::invalid_argument(
          "friction_angle and cohesion are both 0, which leaves no strength; give one of them");
    }
    return strength;
  }

  /// D⁻¹ (trial − stress), in three dimensions.
  SolidTensor plastic_strain(const SolidTensor& trial, const SolidTensor& stress) const {
    const PlaneTensor relief = trial.plane - stress.plane;
    const double zz = trial.zz - stress.zz, twice_shear = 2 * moduli_.shear;
    const double spherical =
        moduli_.across / (3 * moduli_.across + twice_shear) * (relief.xx + relief.yy + zz);
    return {{(relief.xx - spherical) / twice_shear, (relief.yy - spherical) / twice_shear,
             relief.xy / twice_shear},
            (zz - spherical) / twice_shear};
  }

  PlaneModuli moduli_;
  YieldSurface surface_;
  double damping_time_;  ///< s
};

constexpr Component components[] = {
    material<MohrCoulomb>("mohr_coulomb",
                          "Elastic, perfectly plastic in plane strain: Mohr–Coulomb with dilation and a "
                          "tension cut-off.",
                          parameters)};

}  // namespace

TALUS_EXPORT const talus::Library talus_library =
    talus::library("mohr_coulomb", "0.1.0", "the talus authors", components);
