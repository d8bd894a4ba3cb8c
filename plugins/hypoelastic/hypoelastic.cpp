// Elasticity in rate form, as the paper prints it. See README.md beside.

#include <talus/library.hpp>
#include <talus/plane_tensor.hpp>

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

/// The corotational rate of the Cauchy stress is D times the rate of deformation (Eqs. 2, 3, 7), integrated
/// by the midpoint step of Hughes and Winget.
class Hypoelastic final : public Material {
 public:
  explicit Hypoelastic(const double* values)
      : moduli_(values[2] == 0 ? plane_strain_moduli(values[0], values[1])
                               : plane_stress_moduli(values[0], values[1])),
        damping_time_(values[3]) {}

  /// σ_xx, σ_yy, σ_xy, Pa, and the work of the stress, J/m³ of reference volume.
  std::uint32_t doubles_per_element() const noexcept override { return 4; }

  void evaluate(const MaterialBatch& batch, const MaterialResponse& response) const noexcept override {
    if (damping_time_ > 0) {
      respond<true>(batch, response);
    } else {
      respond<false>(batch, response);
    }
  }

  void stiffest_tangent(double tangent[9]) const noexcept override { write_tangent(moduli_, tangent); }

  double viscous_time() const noexcept override { return damping_time_; }

 private:
  /// No branch within, and the arrays are apart: the loop becomes one over vectors.
  template <bool damped>
  void respond(const MaterialBatch& batch, const MaterialResponse& response) const noexcept {
    const double viscosity = damped && batch.dt > 0 ? damping_time_ / batch.dt : 0;
    const PlaneModuli moduli = moduli_;
    const MaterialBatch in = batch;
    const MaterialResponse out = response;
#pragma GCC ivdep
    for (std::uint32_t i = 0; i < in.count; ++i) {
      const TwoPointTensor before = tensor_at(in.previous_deformation, i);
      const TwoPointTensor now = tensor_at(in.deformation, i);
      const double* old = in.state + std::size_t{4} * i;
      const PlaneTensor stress_before{old[0], old[1], old[2]};

      const MidpointStep step = midpoint_step(before, now);
      const PlaneTensor change = moduli * step.strain;
      const PlaneTensor stress = rotated(step.rotation, stress_before) + change;
      const double work = old[3] + stress_work(stress_before, before, stress, now);

      PlaneTensor total = stress;
      if (damped) {
        const PlaneTensor viscous = viscosity * change;
        total = total + viscous;
        write(first_piola(viscous, now), out.viscous_stress, i);
      }
      write(first_piola(total, now), out.stress, i);
      out.energy[i] = work;
      out.dissipated[i] = 0;
      double* state = out.state + std::size_t{4} * i;
      state[0] = stress.xx;
      state[1] = stress.yy;
      state[2] = stress.xy;
      state[3] = work;
    }
  }

  PlaneModuli moduli_;
  double damping_time_;  ///< s
};

constexpr Component components[] = {
    material<Hypoelastic>("hypoelastic",
                          "Isotropic elasticity in rate form (Eqs. 2, 7), stress carried along by Hughes and "
                          "Winget's midpoint step.",
                          parameters)};

}  // namespace

TALUS_EXPORT const talus::Library talus_library =
    talus::library("hypoelastic", "0.1.0", "the talus authors", components);
