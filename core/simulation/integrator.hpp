#pragma once

#include "kernels/elements.hpp"
#include "model/model.hpp"
#include "model/motion.hpp"
#include "scene/scene.hpp"
#include "simulation/patch_mass.hpp"

#include <span>

namespace talus {

/// What happened to the energies at one velocity update, J/m. With K_n = ½ v₋ᵀ M v₊, v₋ and v₊ as far before
/// t_n as after it, a force f_n works over half of the step behind and half of the step ahead; the latter
/// belongs to the ledger of t_{n+1}.
struct AccelerationWork {
  double kinetic = 0;                                 ///< K_n
  double damping_loss = 0, damping_loss_ahead = 0;    ///< by mass-proportional damping
  double external_work = 0, external_work_ahead = 0;  ///< by gravity and driven supports
};

struct StepConditions {
  Vec2 gravity, gravity_behind;  ///< m/s², at t_n and at t_{n−1}
  double damping;                ///< 1/s, mass-proportional
  double dt_behind, dt_ahead;    ///< s; the velocity is updated over their mean (Eq. 23)
  bool supports_driven;          ///< false: driven supports stand still (settling)
};

class Blocks;

/// Patches of a body that a sweep over its elements has brought to v₊ already, and sums over them.
struct UpdatedPatches {
  std::uint32_t end = 0;  ///< from the first of the body to this one; 0: none
  kernels::VelocitySums sums{};
};

/// v₊ = v₋ + Δt M⁻¹ f (Eqs. 23–24), with what supports prescribe. All forces are used up. Velocities at t_n
/// of bodies that move as a whole are left (MotionState::velocity_at_step) only where they are `observed`;
/// those of patches in `at_step` [patch], m/s. `updated`: [body] what is done already; empty: nothing.
AccelerationWork accelerate(const Model& model, const PatchMass& mass, std::span<const Support> supports,
                            const StepConditions& conditions, bool observed, Blocks& blocks,
                            MotionState& motion, std::vector<Vec2>& at_step,
                            std::span<const UpdatedPatches> updated = {});

/// Gives bodies at once the velocities that supports want.
void impose_at_once(const Model& model, const PatchMass& mass, std::span<const Support> supports,
                    MotionState& motion);

/// The moments that deform a body, J/m, without what turns it as a whole about its centroid: where its
/// rotation is prescribed, a support carries that. `h` is ∂u/∂X.
Matrix2 moment_without_spin(const Body& body, const Matrix2& h, const Matrix2& moment);

/// Rate of H of a rigid body that spins.
Matrix2 spin_rate(const BodyMotion& motion);

/// d_{n+1} = d_n + Δt v₊ (Eq. 22). Own patches of bodies of many elements follow when their elements are
/// swept (MotionState::own_behind).
void move(const Model& model, double dt, Blocks& blocks, MotionState& motion);

/// Kinetic energy of a body with velocities p before and q after, ½ pᵀ M q, J/m.
double kinetic_energy(const Body& body, const BodyMotion& p, const BodyMotion& q);

}  // namespace talus
