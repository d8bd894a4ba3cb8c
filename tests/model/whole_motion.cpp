#include "whole_motion.hpp"

namespace talus {

void move_boundary(const Model& model, MotionState& motion) {
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const Body& body = model.bodies[i];
    if (body.kinematics == Kinematics::fixed) continue;
    motion.move_corners(model, i);
    for (std::uint32_t piece = body.piece_begin; piece < body.piece_end; ++piece)
      motion.shape_piece(model, piece);
  }
}

void clear_forces(const Model& model, MotionState& motion) {
  for (const std::uint32_t body : model.moving_bodies) motion.forces[body] = {};
  motion.clear_patch_forces(model);
}

}  // namespace talus
