#include "simulation/relaxation.hpp"

#include "simulation/velocity_update.hpp"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

/// Power of a change of force on a body that moves as a whole; a spin works by the torque.
double power(const Body& body, const BodyMotion& motion, const BodyForce& change) {
  const double moved = change.force.x * motion.velocity.x + change.force.y * motion.velocity.y;
  if (body.kinematics == Kinematics::rigid) return moved + torque(motion, change) * motion.spin;
  const Matrix2 &q = change.moment, &rate = motion.rate;
  return moved + q.xx * rate.xx + q.xy * rate.xy + q.yx * rate.yx + q.yy * rate.yy;
}

BodyForce difference(const BodyForce& p, const BodyForce& q) {
  return {p.force - q.force,
          {p.moment.xx - q.moment.xx, p.moment.xy - q.moment.xy, p.moment.yx - q.moment.yx,
           p.moment.yy - q.moment.yy}};
}

}  // namespace

double Relaxation::damping(const Damping& how, const Model& model, const PatchMass& mass,
                           const MotionState& motion, double dt, double largest) {
  if (how.kind != Damping::Kind::adaptive) {
    last_forces_.clear();  // they would be those of long ago
    return how.kind == Damping::Kind::constant ? how.constant : 0;
  }
  double stiffness = 0, inertia = 0;
  const bool can_tell = last_forces_.size() == motion.forces.size() &&
                        last_patch_forces_.size() == motion.patch_force.size() && dt > 0;
  for (std::uint32_t b = 0; can_tell && b < model.bodies.size(); ++b) {
    const Body& body = model.bodies[b];
    const CoverRanges& ranges = model.ranges(body);
    if (body.kinematics == Kinematics::fixed) continue;
    if (body.kinematics == Kinematics::covered) {
      const std::span<const Vec2> velocity(motion.patch_velocity.data() + ranges.patch_begin,
                                           ranges.patch_end - ranges.patch_begin);
      for (std::size_t i = 0; i < velocity.size(); ++i) {
        const Vec2 now = motion.patch_force[ranges.patch_begin + i],
                   last = last_patch_forces_[ranges.patch_begin + i];
        stiffness -= (now.x - last.x) * velocity[i].x + (now.y - last.y) * velocity[i].y;
      }
      inertia += mass.product(model, b, velocity, velocity);
      continue;
    }
    const BodyMotion& moved = motion.bodies[b];
    stiffness -= power(body, moved, difference(motion.forces[b], last_forces_[b]));
    inertia += 2 * kinetic_energy(body, moved, moved);
  }
  last_forces_ = motion.forces;
  last_patch_forces_ = motion.patch_force;
  return inertia > 0 ? 2 * std::sqrt(std::clamp(stiffness / (dt * inertia), 0.0, largest)) : 0;
}

bool Relaxation::past_peak(const Damping& how, double kinetic, double gone) {
  if (how.kind != Damping::Kind::kinetic) {
    last_kinetic_ = 0;
    return false;
  }
  const bool past = kinetic < last_kinetic_;
  last_kinetic_ = past ? 0 : kinetic - gone;
  return past;
}

void Relaxation::forget() {
  last_forces_.clear();
  last_kinetic_ = 0;
}

double Relaxation::unbalanced(const Model& model, const PatchMass& mass, const MotionState& motion,
                              std::span<const Support> supports, Vec2 gravity) const {
  double sum = 0;
  std::vector<Vec2> acceleration = motion.patch_force;
  for (std::uint32_t b = 0; b < model.bodies.size(); ++b) {
    const Body& body = model.bodies[b];
    const CoverRanges& ranges = model.ranges(body);
    if (body.kinematics == Kinematics::fixed) continue;
    const Support& support = support_of(supports, b);
    if (body.kinematics == Kinematics::covered) {
      mass.accelerations(model, b, {acceleration, 0});
      const std::span<Vec2> own(acceleration.data() + ranges.patch_begin,
                                ranges.patch_end - ranges.patch_begin);
      for (Vec2& of_patch : own) of_patch += gravity;
      leave_out_supported(model, mass, b, support, motion, own);
      for (std::size_t i = 0; i < own.size(); ++i)
        sum += model.patch_mass[ranges.patch_begin + i] * size_of(own[i]);
      continue;
    }
    const BodyForce& force = motion.forces[b];
    sum += size_of({support.x ? 0 : force.force.x + body.mass * gravity.x,
                    support.y ? 0 : force.force.y + body.mass * gravity.y});
    if (body.kinematics == Kinematics::rigid) {
      sum += support.rotation ? 0 : std::abs(torque(motion.bodies[b], force)) / body.width;
    } else {
      const Matrix2 q =
          support.rotation ? moment_without_spin(body, motion.bodies[b].h, force.moment) : force.moment;
      sum += std::sqrt(q.xx * q.xx + q.xy * q.xy + q.yx * q.yx + q.yy * q.yy) / body.width;
    }
  }
  return sum;
}

void Relaxation::exchange(Archive& archive) {
  archive(last_forces_);
  archive(last_patch_forces_);
  archive(last_kinetic_);
}

double Relaxation::weight(const Model& model, Vec2 gravity) {
  double sum = 0;
  for (const Body& body : model.bodies) {
    if (body.kinematics != Kinematics::fixed) sum += body.mass * size_of(gravity);
  }
  return sum;
}

}  // namespace talus
