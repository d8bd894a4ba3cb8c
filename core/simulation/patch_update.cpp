#include "simulation/velocity_update.hpp"

#include <algorithm>

// Vectors of a size that depends on the body keep their room from call to call: a step asks for no memory.

namespace talus {
namespace {

/// The velocity of each patch when the body spins by 1 rad/s about its centre of mass, in the present shape.
void unit_spin(const Model& model, const Body& body, const MotionState& motion, std::vector<Vec2>& spin) {
  const CoverRanges& ranges = model.ranges(body);
  Vec2 centre;
  for (std::uint32_t p = ranges.patch_begin; p < ranges.patch_end; ++p) {
    const double share = model.patch_mass[p] / body.mass;
    centre += share * (model.patch_star[p] + motion.patch_displacement[p]);
  }
  spin.clear();
  for (std::uint32_t p = ranges.patch_begin; p < ranges.patch_end; ++p) {
    const Vec2 at = model.patch_star[p] + motion.patch_displacement[p];
    spin.push_back({-(at.y - centre.y), at.x - centre.x});
  }
}

/// Replaces the share that the motions which a support prescribes have in a field over the patches of a body:
/// by what target(prescribed, generalised mass, share, motion) says. Moving the centre of mass and turning
/// about it are orthogonal in the mass, so taking one out leaves the other as it is.
template <class Target>
void replace_supported(const Model& model, const PatchMass& mass, std::uint32_t index, const Support& support,
                       const MotionState& motion, std::span<Vec2> field, const Target& target) {
  const Body& body = model.bodies[index];
  static thread_local std::vector<Vec2> mode;
  const auto replace_mode = [&](double prescribed) {
    const double inertia = mass.product(model, index, mode, mode);
    const double share = mass.product(model, index, field, mode) / inertia;
    const double change = target(prescribed, inertia, share, mode) - share;
    for (std::size_t i = 0; i < field.size(); ++i) field[i] += change * mode[i];
  };
  if (support.x) {
    mode.assign(field.size(), {1, 0});
    replace_mode(*support.x);
  }
  if (support.y) {
    mode.assign(field.size(), {0, 1});
    replace_mode(*support.y);
  }
  if (support.rotation) {
    unit_spin(model, body, motion, mode);
    replace_mode(*support.rotation);
  }
}

/// K_n as for bodies that move as a whole: with steps of unequal length, by the velocity mirrored about t_n.
double kinetic_at_step(const Model& model, const PatchMass& mass, std::uint32_t body, std::uint32_t first,
                       const StepConditions& conditions, std::span<const Vec2> before,
                       std::span<const Vec2> at_step, std::span<const Vec2> after) {
  if (conditions.dt_behind == conditions.dt_ahead) return mass.product(model, body, first, before, after) / 2;
  const std::span<const Vec2> side = conditions.dt_behind > 0 ? before : after;
  static thread_local std::vector<Vec2> mirrored;
  mirrored.clear();
  for (std::size_t i = 0; i < side.size(); ++i) mirrored.push_back(2 * at_step[i] - side[i]);
  return mass.product(model, body, first, side, mirrored) / 2;
}

/// The same of updated patches, from the products of v₋ and v₊: v = v₋ + s (v₊ − v₋) is mirrored to (1 − 2s)
/// v₋ + 2s v₊, at the start (s = 0) to 2 v₋ − v₊.
double kinetic_at_step(const kernels::VelocitySums& sums, const StepConditions& conditions) {
  if (conditions.dt_behind == conditions.dt_ahead) return sums.across / 2;
  const double share = share_of_after(conditions);
  if (conditions.dt_behind > 0) return ((1 - 2 * share) * sums.before + 2 * share * sums.across) / 2;
  return (2 * sums.across - sums.after) / 2;
}

}  // namespace

void leave_out_supported(const Model& model, const PatchMass& mass, std::uint32_t body,
                         const Support& support, const MotionState& motion, std::span<Vec2> acceleration) {
  replace_supported(model, mass, body, support, motion, acceleration,
                    [](double, double, double, std::span<const Vec2>) { return 0.0; });
}

void impose_on_patches(const Model& model, const PatchMass& mass, std::uint32_t body, const Support& support,
                       MotionState& motion) {
  const CoverRanges& ranges = model.ranges(model.bodies[body]);
  const std::span<Vec2> velocity(motion.patch_velocity.data() + ranges.patch_begin,
                                 ranges.patch_end - ranges.patch_begin);
  replace_supported(model, mass, body, support, motion, velocity,
                    [](double wanted, double, double, std::span<const Vec2>) { return wanted; });
}

void accelerate_patches(const Model& model, const PatchMass& mass, std::uint32_t index,
                        const Support& support, const StepConditions& conditions, const Update& update,
                        const UpdatedPatches& updated, MotionState& motion, std::vector<Vec2>& at_step,
                        AccelerationWork& work) {
  const Body& body = model.bodies[index];
  const CoverRanges& ranges = model.ranges(body);
  const std::uint32_t first = std::max(updated.end, ranges.patch_begin);
  const std::size_t count = ranges.patch_end - first;
  const std::span<Vec2> after(motion.patch_velocity.data() + first, count);
  const std::span<Vec2> middle(at_step.data() + first, count);
  static thread_local std::vector<Vec2> before;
  before.assign(after.begin(), after.end());

  mass.accelerations(model, index, first, {motion.patch_force, 0});
  Vec2 momentum{updated.sums.momentum[0], updated.sums.momentum[1]};
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 acceleration = motion.patch_force[first + i] + conditions.gravity;
    after[i] = update.keep * after[i] + update.gain * acceleration;
    momentum += model.patch_mass[first + i] * before[i];
  }
  replace_supported(model, mass, index, support, motion, after,
                    [&](double prescribed, double inertia, double value, std::span<const Vec2> mode) {
                      const double value_before = mass.product(model, index, before, mode) / inertia;
                      return impose(prescribed, inertia, value, value_before, conditions, update, work);
                    });
  const double share = share_of_after(conditions);
  for (std::size_t i = 0; i < count; ++i) middle[i] = before[i] + share * (after[i] - before[i]);

  work.kinetic += kinetic_at_step(model, mass, index, first, conditions, before, middle, after) +
                  kinetic_at_step(updated.sums, conditions);
  work.external_work += gravity_work(conditions, momentum);
  if (conditions.damping > 0) {
    // With the mean of both velocities, which is not that at t_n where steps are uneven.
    static thread_local std::vector<Vec2> mean;
    mean.assign(middle.begin(), middle.end());
    for (std::size_t i = 0; share != 0.5 && i < count; ++i) mean[i] = (before[i] + after[i]) / 2;
    const double behind = mass.product(model, index, first, mean, before) + 0.5 * updated.sums.before +
                          0.5 * updated.sums.across;
    const double ahead =
        mass.product(model, index, first, mean, after) + 0.5 * updated.sums.across + 0.5 * updated.sums.after;
    work.damping_loss += conditions.damping * behind * conditions.dt_behind / 2;
    work.damping_loss_ahead += conditions.damping * ahead * conditions.dt_ahead / 2;
  }
}

}  // namespace talus
