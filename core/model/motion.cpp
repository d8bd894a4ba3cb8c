#include "model/motion.hpp"

#include "model/strips.hpp"

#include <cmath>

namespace talus {

MotionState::MotionState(const Model& model)
    : bodies(model.bodies.size()),
      forces(model.bodies.size()),
      patch_displacement(model.patch_star.size()),
      patch_velocity(model.patch_star.size()),
      patch_force(model.patch_star.size()),
      corners(model.reference_x.size()) {
  for (std::size_t c = 0; c < corners.size(); ++c) {
    corners[c] = {};
    corners[c].x = model.reference_x[c];
    corners[c].y = model.reference_y[c];
    corners[c].surface = model.surface[c];
    corners[c].cut = model.cut[c];
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    move_corners(model, i);
    for (std::uint32_t piece = model.bodies[i].piece_begin; piece < model.bodies[i].piece_end; ++piece)
      shape_piece(model, piece);
  }
}

Vec2 displacement(const BodyMotion& m, Vec2 p) {
  return {m.u.x + m.h.xx * p.x + m.h.xy * p.y, m.u.y + m.h.yx * p.x + m.h.yy * p.y};
}

Vec2 velocity(const BodyVelocity& m, Vec2 p) {
  return {m.velocity.x + m.rate.xx * p.x + m.rate.xy * p.y, m.velocity.y + m.rate.yx * p.x + m.rate.yy * p.y};
}

void MotionState::exchange(Archive& archive) {
  archive.of_known_size(bodies);
  archive.of_known_size(patch_displacement);
  archive.of_known_size(patch_velocity);
  archive(own_behind);
  archive.of_known_size(corners);
}

Vec2 MotionState::displacement(const MaterialPoint& point) const {
  if (point.carrier.patch[0] == no_patch) return talus::displacement(bodies[point.body], point.reference);
  return carried(point.carrier, patch_displacement);
}

Vec2 MotionState::velocity(const MaterialPoint& point) const {
  if (point.carrier.patch[0] == no_patch) return talus::velocity(bodies[point.body], point.reference);
  return carried(point.carrier, patch_velocity);
}

void MotionState::add_force(const MaterialPoint& point, Vec2 load) {
  if (point.carrier.patch[0] == no_patch) {
    forces[point.body].add(point.reference, load);
    return;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    Vec2& force = patch_force[point.carrier.patch[i]];
    force.x += point.carrier.weight[i] * load.x;
    force.y += point.carrier.weight[i] * load.y;
  }
}

void MotionState::clear_patch_forces(const Model& model) {
  for (const std::uint32_t index : model.covered_bodies) {
    const Body& body = model.bodies[index];
    const CoverRanges& ranges = model.ranges(body);
    for (std::uint32_t p = ranges.own_end; p < ranges.patch_end; ++p) patch_force[p] = {};
  }
}

void MotionState::stop() {
  for (BodyMotion& body : bodies) body.velocity = {}, body.rate = {}, body.spin = 0;
  for (Vec2& velocity : patch_velocity) velocity = {};
}

void MotionState::average(const Model& model, std::uint32_t index) {
  const Body& body = model.bodies[index];
  const CoverRanges& ranges = model.ranges(body);
  BodyMotion mean;
  for (std::uint32_t p = ranges.patch_begin; p < ranges.patch_end; ++p) {
    const double share = model.patch_mass[p] / body.mass;
    mean.u.x += share * patch_displacement[p].x;
    mean.u.y += share * patch_displacement[p].y;
    mean.velocity.x += share * patch_velocity[p].x;
    mean.velocity.y += share * patch_velocity[p].y;
  }
  const auto add = [](Matrix2& sum, Vec2 value, Vec2 g) {
    sum.xx += value.x * g.x;
    sum.xy += value.x * g.y;
    sum.yx += value.y * g.x;
    sum.yy += value.y * g.y;
  };
  for (std::uint32_t i = ranges.outer_begin; i < ranges.outer_end; ++i) {
    const auto& [patch, g] = model.outer_patches[i];
    add(mean.h, patch_displacement[patch] - mean.u, g);
    add(mean.rate, patch_velocity[patch] - mean.velocity, g);
  }
  bodies[index] = mean;
}

void MotionState::shape_piece(const Model& model, std::uint32_t piece) {
  if (model.is_strip[piece] != 0) shape_strip(model, piece, *this);
  const std::uint32_t begin = model.piece_start[piece], end = model.piece_start[piece + 1];
  measure_sides(std::span(corners).subspan(begin, end - begin));
}

void MotionState::move_corners(const Model& model, std::size_t index) {
  const Body& body = model.bodies[index];
  const CoverRanges& ranges = model.ranges(body);
  if (body.kinematics == Kinematics::covered) {
    for (std::uint32_t side = ranges.side_begin; side < ranges.side_end; ++side)
      move_start(model, body, side);
    return;
  }
  const BodyMotion& motion = bodies[index];
  for (std::uint32_t c = body.corner_begin; c < body.corner_end; ++c) {
    const Vec2 reference{model.reference_x[c], model.reference_y[c]};
    const Vec2 moved = talus::displacement(motion, reference), speed = talus::velocity(motion, reference);
    corners[c].x = reference.x + moved.x;
    corners[c].y = reference.y + moved.y;
    corners[c].vx = speed.x;
    corners[c].vy = speed.y;
  }
}

Vec2 MotionState::move_start(const Model& model, const Body& body, std::uint32_t side) {
  const MaterialPoint& point = model.sides[side].start;
  const Vec2 moved = carried(point.carrier, patch_displacement),
             speed = carried(point.carrier, patch_velocity);
  // A side ends where the next one starts.
  for (const std::uint32_t c :
       {model.side_corner(body, side), model.side_corner(body, model.previous_side[side]) + 1}) {
    corners[c].x = point.reference.x + moved.x;
    corners[c].y = point.reference.y + moved.y;
    corners[c].vx = speed.x;
    corners[c].vy = speed.y;
  }
  return speed;
}

void measure_sides(std::span<BoundaryCorner> ring) {
  for (std::size_t c = 0; c < ring.size(); ++c) {
    BoundaryCorner& corner = ring[c];
    const BoundaryCorner& next = ring[c + 1 == ring.size() ? 0 : c + 1];
    const double dx = next.x - corner.x, dy = next.y - corner.y;
    corner.length = std::sqrt(dx * dx + dy * dy);
    corner.tangent_x = corner.length > 0 ? dx / corner.length : 0;
    corner.tangent_y = corner.length > 0 ? dy / corner.length : 0;
  }
}

Matrix2 rotation_of(const Matrix2& h) {
  const double c = 2 + h.xx + h.yy, s = h.yx - h.xy, size = std::sqrt(c * c + s * s);
  return {c / size - 1, -s / size, s / size, c / size - 1};
}

}  // namespace talus
