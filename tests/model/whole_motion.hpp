#pragma once

#include "model/model.hpp"
#include "model/motion.hpp"

namespace talus {

/// Corners of all moving bodies follow, and every piece is shaped, in a pair or not.
void move_boundary(const Model& model, MotionState& motion);

/// Makes room for the forces of a step on bodies and on patches that they share.
void clear_forces(const Model& model, MotionState& motion);

}  // namespace talus
