#include "simulation/since_start.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus {

SinceStart::SinceStart(const Model& model, bool settles)
    : settles_(settles),
      bodies_(settles ? model.bodies.size() : 0),
      patches_(settles ? model.patch_star.size() : 0),
      rotation_(model.bodies.size(), 0.0) {}

void SinceStart::begin(const Model& model, MotionState& motion) {
  if (settles_) {
    bodies_ = motion.bodies;
    patches_ = motion.patch_displacement;
  }
  follow(model, motion);
  if (std::ranges::any_of(rotation_, [](double angle) { return angle != 0; })) rotation_at_start_ = rotation_;
}

void SinceStart::follow(double most, const Model& model, MotionState& motion) {
  turned_ += most;
  if (turned_ > 1) follow(model, motion);
}

void SinceStart::follow(const Model& model, MotionState& motion) {
  turned_ = 0;
  for (const std::uint32_t i : model.moving_bodies) {
    if (model.covered(i)) motion.average(model, i);
    // The angle of the polar rotation, less than half a turn from where it was.
    const Vec2 now = turn_of(motion.bodies[i].h);
    rotation_[i] += std::remainder(std::atan2(now.y, now.x) - rotation_[i], 2 * std::numbers::pi);
  }
}

Vec2 SinceStart::displacement_at_start(std::uint32_t body, Vec2 reference) const {
  return settles_ ? displacement(bodies_[body], reference) : Vec2{};
}

Vec2 SinceStart::displacement_at_start(const Carrier& carrier) const {
  return settles_ ? carried(carrier, patches_) : Vec2{};
}

void SinceStart::exchange(Archive& archive) {
  archive.of_known_size(bodies_);
  archive.of_known_size(patches_);
  archive.of_known_size(rotation_);
  archive(rotation_at_start_);
  if (!rotation_at_start_.empty() && rotation_at_start_.size() != rotation_.size()) Archive::refuse();
  archive(turned_);
}

}  // namespace talus
