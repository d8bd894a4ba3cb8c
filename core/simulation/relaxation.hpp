#pragma once

#include "archive/archive.hpp"
#include "model/model.hpp"
#include "model/motion.hpp"
#include "scene/scene.hpp"
#include "simulation/integrator.hpp"
#include "simulation/patch_mass.hpp"

#include <span>
#include <vector>

namespace talus {

/// Brings a scene to rest (dynamic relaxation): global damping that is critical for the motion there is, or
/// velocities taken away at each peak of the kinetic energy.
class Relaxation {
 public:
  /// Global damping for the coming step, 1/s. Adaptive: 2ω with ω² = −v·Δf / (Δt v·M v), the Rayleigh
  /// quotient of the present motion v = v_{n−1/2}; Δf is the change of all forces over the last step. Viscous
  /// ones change with the velocity, and are no stiffness: ω² is `largest`, 1/s², at most.
  double damping(const Damping& how, const Model& model, const PatchMass& mass, const MotionState& motion,
                 double dt, double largest);

  /// Kinetic damping: whether the kinetic energy, J/m, has passed a peak, so that velocities are to be taken.
  /// `gone` of it went with bodies that fell asleep since.
  bool past_peak(const Damping& how, double kinetic, double gone = 0);

  /// The motion so far has nothing to do with what comes.
  void forget();

  /// Sum of the magnitudes of the forces that accelerate bodies and patches, N/m, without what supports
  /// carry; for a body that moves as a whole, its resultant and its moments over its width.
  double unbalanced(const Model& model, const PatchMass& mass, const MotionState& motion,
                    std::span<const Support> supports, Vec2 gravity) const;
  void exchange(Archive& archive);

  static double weight(const Model& model, Vec2 gravity);

 private:
  std::vector<BodyForce> last_forces_;
  std::vector<Vec2> last_patch_forces_;
  double last_kinetic_ = 0;
};

}  // namespace talus
