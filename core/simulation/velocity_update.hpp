#pragma once

#include "simulation/integrator.hpp"

#include <optional>

namespace talus {

/// v₊ = keep v₋ + gain a, mass-proportional damping taken at mid-step.
struct Update {
  double keep, gain;
};

inline Update update_of(const StepConditions& conditions) {
  const double dt = (conditions.dt_behind + conditions.dt_ahead) / 2;
  const double half_damping = conditions.damping * dt / 2;
  return {(1 - half_damping) / (1 + half_damping), dt / (1 + half_damping)};
}

/// Books the work of the reaction that makes the velocity of one motion, of generalised mass `mass`, what a
/// support wants; returns that velocity.
inline double impose(const std::optional<double>& wanted, double mass, double value, double value_before,
                     const StepConditions& conditions, const Update& update, AccelerationWork& work) {
  const double target = conditions.supports_driven ? *wanted : 0;
  const double reaction = mass * (target - value) / update.gain;
  work.external_work += reaction * value_before * conditions.dt_behind / 2;
  work.external_work_ahead += reaction * target * conditions.dt_ahead / 2;
  return target;
}

/// Work of gravity per mass over the step behind, by the trapezoidal rule, J/kg.
inline double gravity_work(const StepConditions& conditions, Vec2 velocity) {
  const Vec2 &now = conditions.gravity, &before = conditions.gravity_behind;
  return conditions.dt_behind * ((now.x + before.x) * velocity.x + (now.y + before.y) * velocity.y) / 2;
}

/// Share of v₊ in the velocity at t_n; one half for equal steps.
inline double share_of_after(const StepConditions& conditions) {
  return conditions.dt_behind / (conditions.dt_behind + conditions.dt_ahead);
}

/// Takes what supports prescribe out of accelerations of the patches of a body of many elements.
void leave_out_supported(const Model& model, const PatchMass& mass, std::uint32_t body,
                         const Support& support, const MotionState& motion, std::span<Vec2> acceleration);

/// Gives the patches of a body at once the motions that a support wants.
void impose_on_patches(const Model& model, const PatchMass& mass, std::uint32_t body, const Support& support,
                       MotionState& motion);

/// The patches of a body of many elements that are left.
void accelerate_patches(const Model& model, const PatchMass& mass, std::uint32_t body, const Support& support,
                        const StepConditions& conditions, const Update& update, const UpdatedPatches& updated,
                        MotionState& motion, std::vector<Vec2>& at_step, AccelerationWork& work);

}  // namespace talus
