#include "simulation/integrator.hpp"

#include "simulation/blocks.hpp"
#include "simulation/strain_mass.hpp"
#include "simulation/velocity_update.hpp"

namespace talus {
namespace {

/// tr(P ρJ Qᵀ): the deformation part of the mass as an inner product of two rates.
double product(const CentralMoments& m, double density, const Matrix2& p, const Matrix2& q) {
  const double first = p.xx * (m.xx * q.xx + m.xy * q.xy) + p.xy * (m.xy * q.xx + m.yy * q.xy);
  const double second = p.yx * (m.xx * q.yx + m.xy * q.yy) + p.yy * (m.xy * q.yx + m.yy * q.yy);
  return density * (first + second);
}

/// Rate of H under a spin of 1 rad/s about the centroid, in the present shape: W F.
Matrix2 unit_spin(const Matrix2& h) {
  return {-h.yx, -(1 + h.yy), 1 + h.xx, h.xy};
}

/// rad/s, the share of a unit of spin in a rate of H.
double turning_of(const Body& body, const Matrix2& rate, const Matrix2& spin) {
  return product(body.moments, 1, rate, spin) / product(body.moments, 1, spin, spin);
}

void add(Matrix2& to, double factor, const Matrix2& what) {
  to.xx += factor * what.xx;
  to.xy += factor * what.xy;
  to.yx += factor * what.yx;
  to.yy += factor * what.yy;
}

void accelerate_freely(const Body& body, const BodyForce& force, const StepConditions& conditions,
                       Update update, BodyMotion& motion) {
  motion.velocity.x =
      update.keep * motion.velocity.x + update.gain * (force.force.x / body.mass + conditions.gravity.x);
  motion.velocity.y =
      update.keep * motion.velocity.y + update.gain * (force.force.y / body.mass + conditions.gravity.y);
  if (body.kinematics == Kinematics::rigid) {
    motion.spin = update.keep * motion.spin + update.gain * torque(motion, force) / body.inertia();
    return;
  }
  const Matrix2 &q = force.moment, inverse = body.inverse_moment();
  const double xx = q.xx * inverse.xx + q.xy * inverse.yx, xy = q.xx * inverse.xy + q.xy * inverse.yy;
  const double yx = q.yx * inverse.xx + q.yy * inverse.yx, yy = q.yx * inverse.xy + q.yy * inverse.yy;
  Matrix2 acceleration{xx, xy, yx, yy};
  if (body.strain_mass_scale != 1)
    acceleration = StrainMass(body, body.density(), motion.h).acceleration(acceleration);
  motion.rate.xx = update.keep * motion.rate.xx + update.gain * acceleration.xx;
  motion.rate.xy = update.keep * motion.rate.xy + update.gain * acceleration.xy;
  motion.rate.yx = update.keep * motion.rate.yx + update.gain * acceleration.yx;
  motion.rate.yy = update.keep * motion.rate.yy + update.gain * acceleration.yy;
}

/// Puts the prescribed parts of the motion in place and books the work of the reactions. Moving the centroid
/// and turning about it are orthogonal in the mass, so taking one out leaves the others as they are.
void impose_supports(const Body& body, const Support& support, const StepConditions& conditions,
                     Update update, const BodyMotion& before, BodyMotion& after, AccelerationWork& work) {
  const auto impose = [&](const std::optional<double>& wanted, double mass, double value,
                          double value_before) {
    return talus::impose(wanted, mass, value, value_before, conditions, update, work);
  };
  if (support.x) after.velocity.x = impose(support.x, body.mass, after.velocity.x, before.velocity.x);
  if (support.y) after.velocity.y = impose(support.y, body.mass, after.velocity.y, before.velocity.y);
  if (!support.rotation) return;
  if (body.kinematics == Kinematics::rigid) {
    after.spin = impose(support.rotation, body.inertia(), after.spin, before.spin);
    return;
  }
  const Matrix2 spin = unit_spin(after.h);
  const double inertia = product(body.moments, body.density(), spin, spin);
  const double turning = turning_of(body, after.rate, spin);
  const double turning_before = turning_of(body, before.rate, spin);
  add(after.rate, impose(support.rotation, inertia, turning, turning_before) - turning, spin);
}

/// Between the velocities of the half steps behind and ahead: that at t_n for share_of_after().
BodyMotion velocity_between(const BodyMotion& p, const BodyMotion& q, double share) {
  const auto between = [&](double before, double after) { return before + share * (after - before); };
  BodyMotion result = q;
  result.velocity = {between(p.velocity.x, q.velocity.x), between(p.velocity.y, q.velocity.y)};
  result.spin = between(p.spin, q.spin);
  result.rate = {between(p.rate.xx, q.rate.xx), between(p.rate.xy, q.rate.xy), between(p.rate.yx, q.rate.yx),
                 between(p.rate.yy, q.rate.yy)};
  return result;
}

/// The velocity as far on the other side of t_n as `side` is on this one.
BodyMotion mirrored(const BodyMotion& at_step, const BodyMotion& side) {
  const auto mirror = [](double middle, double value) { return 2 * middle - value; };
  BodyMotion result = at_step;
  result.velocity = {mirror(at_step.velocity.x, side.velocity.x),
                     mirror(at_step.velocity.y, side.velocity.y)};
  result.spin = mirror(at_step.spin, side.spin);
  result.rate = {mirror(at_step.rate.xx, side.rate.xx), mirror(at_step.rate.xy, side.rate.xy),
                 mirror(at_step.rate.yx, side.rate.yx), mirror(at_step.rate.yy, side.rate.yy)};
  return result;
}

/// ½ v₋ᵀ M v₊ as if the step ahead were as long as the one behind (at the start: the one behind as the one
/// ahead). With the velocities of uneven steps the product would miss energy of first order in their
/// difference.
double kinetic_at_step(const Body& body, const StepConditions& conditions, const BodyMotion& before,
                       const BodyMotion& at_step, const BodyMotion& after) {
  if (conditions.dt_behind == conditions.dt_ahead) return kinetic_energy(body, before, after);
  const BodyMotion& side = conditions.dt_behind > 0 ? before : after;
  return kinetic_energy(body, side, mirrored(at_step, side));
}

/// A body that moves as a whole, with supports or scaled strain, which the kernels do not know.
void accelerate_whole(const Body& body, std::uint32_t index, const Support& support,
                      const StepConditions& conditions, Update update, MotionState& motion,
                      AccelerationWork& work) {
  BodyMotion& now = motion.bodies[index];
  const bool scaled = body.strain_mass_scale != 1;
  // The terms of the turning frame, half of them before the forces and half after: both velocities are then
  // those at t_n but for the forces, which the energy needs.
  if (scaled) now.rate = StrainMass(body, body.density(), now.h).turned(now.rate, conditions.dt_behind / 2);
  const BodyMotion before = now;
  accelerate_freely(body, motion.forces[index], conditions, update, now);
  impose_supports(body, support, conditions, update, before, now, work);
  BodyMotion middle = velocity_between(before, now, share_of_after(conditions));
  work.kinetic += kinetic_at_step(body, conditions, before, middle, now);
  if (body.kinematics == Kinematics::rigid) middle.rate = spin_rate(middle);
  motion.leave_velocity(index, {middle.velocity, middle.rate});
  work.external_work += body.mass * gravity_work(conditions, before.velocity);
  if (conditions.damping > 0) {
    const BodyMotion mean = velocity_between(before, now, 0.5);  // of uneven steps not that at t_n
    work.damping_loss += conditions.damping * kinetic_energy(body, mean, before) * conditions.dt_behind;
    work.damping_loss_ahead += conditions.damping * kinetic_energy(body, mean, now) * conditions.dt_ahead;
  }
  if (scaled) now.rate = StrainMass(body, body.density(), now.h).turned(now.rate, conditions.dt_ahead / 2);
}

}  // namespace

double kinetic_energy(const Body& body, const BodyMotion& p, const BodyMotion& q) {
  const double translation = body.mass * (p.velocity.x * q.velocity.x + p.velocity.y * q.velocity.y);
  const auto rest = [&] {
    if (body.kinematics == Kinematics::rigid) return body.inertia() * p.spin * q.spin;
    if (body.strain_mass_scale != 1) return StrainMass(body, body.density(), q.h).product(p.rate, q.rate);
    return product(body.moments, body.density(), p.rate, q.rate);
  };
  return (translation + rest()) / 2;
}

AccelerationWork accelerate(const Model& model, const PatchMass& mass, std::span<const Support> supports,
                            const StepConditions& conditions, bool observed, Blocks& blocks,
                            MotionState& motion, std::vector<Vec2>& at_step,
                            std::span<const UpdatedPatches> updated) {
  AccelerationWork work;
  blocks.accelerate(conditions, observed, motion, work);
  const Update update = update_of(conditions);
  for (const std::uint32_t i : blocks.left_to_others()) {
    if (blocks.is_asleep(i)) continue;
    const Body& body = model.bodies[i];
    if (body.kinematics == Kinematics::covered) {
      accelerate_patches(model, mass, i, support_of(supports, i), conditions, update,
                         updated.empty() ? UpdatedPatches{} : updated[i], motion, at_step, work);
      continue;
    }
    accelerate_whole(body, i, support_of(supports, i), conditions, update, motion, work);
  }
  blocks.over_scaled(work, [&](std::uint32_t i, AccelerationWork& part) {
    accelerate_whole(model.bodies[i], i, support_of(supports, i), conditions, update, motion, part);
  });
  return work;
}

void impose_at_once(const Model& model, const PatchMass& mass, std::span<const Support> supports,
                    MotionState& motion) {
  for (const std::uint32_t i : model.moving_bodies) {
    const Support& support = support_of(supports, i);
    if (!support.any()) continue;
    const Body& body = model.bodies[i];
    BodyMotion& now = motion.bodies[i];
    if (body.kinematics == Kinematics::covered) {
      impose_on_patches(model, mass, i, support, motion);
      continue;
    }
    now.velocity = {support.x.value_or(now.velocity.x), support.y.value_or(now.velocity.y)};
    if (!support.rotation) continue;
    if (body.kinematics == Kinematics::rigid) {
      now.spin = *support.rotation;
      continue;
    }
    const Matrix2 spin = unit_spin(now.h);
    add(now.rate, *support.rotation - turning_of(body, now.rate, spin), spin);
  }
}

Matrix2 moment_without_spin(const Body& body, const Matrix2& h, const Matrix2& moment) {
  const CentralMoments& m = body.moments;
  const double density = body.density();
  const Matrix2 spin = unit_spin(h);
  // The reaction is that of a spin, λ W F ρJ, with the work of the moments on a unit of spin.
  const double work = moment.xx * spin.xx + moment.xy * spin.xy + moment.yx * spin.yx + moment.yy * spin.yy;
  const double reaction = -density * work / product(m, density, spin, spin);
  Matrix2 rest = moment;
  add(rest, reaction,
      {spin.xx * m.xx + spin.xy * m.xy, spin.xx * m.xy + spin.xy * m.yy, spin.yx * m.xx + spin.yy * m.xy,
       spin.yx * m.xy + spin.yy * m.yy});
  return rest;
}

Matrix2 spin_rate(const BodyMotion& motion) {
  const Matrix2 spin = unit_spin(motion.h);
  return {motion.spin * spin.xx, motion.spin * spin.xy, motion.spin * spin.yx, motion.spin * spin.yy};
}

void move(const Model& model, double dt, Blocks& blocks, MotionState& motion) {
  for (const std::uint32_t index : model.covered_bodies) {
    const Body& body = model.bodies[index];
    const CoverRanges& ranges = model.ranges(body);
    for (std::uint32_t p = ranges.own_end; p < ranges.patch_end; ++p) {
      motion.patch_displacement[p].x += dt * motion.patch_velocity[p].x;
      motion.patch_displacement[p].y += dt * motion.patch_velocity[p].y;
    }
  }
  motion.own_behind = dt;
  blocks.move(dt, motion);
}

}  // namespace talus
