#pragma once

#include "archive/archive.hpp"
#include "model/model.hpp"
#include "model/patch_values.hpp"

#include <talus/contact_model.hpp>

#include <algorithm>
#include <span>
#include <vector>

namespace talus {

/// Where a body is and how it moves: x = X + u + H X, X relative to the body's centroid at the start, x
/// too. Velocities are those of the half step, so that x_n − x_{n−1} = v Δt (Eq. 22).
struct BodyMotion {
  Vec2 u;           ///< m
  Matrix2 h;        ///< displacement gradient; R − I of a rigid body
  Vec2 velocity;    ///< m/s
  Matrix2 rate;     ///< 1/s
  double spin = 0;  ///< rad/s, of a rigid body
};

/// What a BodyMotion says of the velocity of its points.
struct BodyVelocity {
  Vec2 velocity;  ///< m/s
  Matrix2 rate;   ///< 1/s
};

/// Generalised forces of a body: ΣF and ΣF ⊗ X, per metre of thickness.
struct BodyForce {
  Vec2 force;      ///< N/m
  Matrix2 moment;  ///< N, F_i X_J

  void add(Vec2 at_reference, Vec2 load) {
    force.x += load.x;
    force.y += load.y;
    moment.xx += load.x * at_reference.x;
    moment.xy += load.x * at_reference.y;
    moment.yx += load.y * at_reference.x;
    moment.yy += load.y * at_reference.y;
  }
};

/// State of all bodies at t_n and the corners of their pieces.
struct MotionState {
  explicit MotionState(const Model& model);

  std::vector<BodyMotion> bodies;        ///< of a body of many elements: the mean, as of the last average()
  std::vector<BodyForce> forces;         ///< or velocities at t_n, see velocity_at_step()
  std::vector<Vec2> patch_displacement;  ///< [patch] m
  std::vector<Vec2> patch_velocity;      ///< [patch] m/s
  std::vector<Vec2> patch_force;         ///< [patch] N/m
  double own_behind = 0;  ///< s of motion that own patches (see Partition) have yet to catch up with
  /// In the frame of the body. Of a body of several pieces, tangents, lengths and the inner corners of strips
  /// are as of the last shape_piece(): a piece that no pair lists is shaped for searches alone.
  std::vector<BoundaryCorner> corners;

  /// Corners follow their moving body (Eq. 11): where they are and how fast, of a body of many elements the
  /// ends of its sides.
  void move_corners(const Model& model, std::size_t body);
  /// The same of the corner where a side of a body of many elements starts. Returns its velocity.
  Vec2 move_start(const Model& model, const Body& body, std::uint32_t side);
  /// Then what contact reads of a piece: the rest of a strip, tangents and lengths of sides.
  void shape_piece(const Model& model, std::uint32_t piece);

  /// Makes room for the forces of a step on common patches. Own patches are set later.
  void clear_patch_forces(const Model& model);

  /// The velocity at t_n of a body that moves as a whole, after a step that is looked at: it takes the place
  /// of the force, which has done all it does by then.
  BodyVelocity velocity_at_step(std::size_t body) const { return {forces[body].force, forces[body].moment}; }
  void leave_velocity(std::size_t body, const BodyVelocity& at_step) {
    forces[body] = {at_step.velocity, at_step.rate};
  }

  /// Takes all velocities away.
  void stop();

  /// Brings `bodies` of a body of many elements up to date: motion of the centre of mass, mean gradient and
  /// mean rate over its area, which follow from the patches around it (see OuterPatch).
  void average(const Model& model, std::uint32_t body);

  /// What does not follow from the rest at the next step.
  void exchange(Archive& archive);

  Vec2 displacement(const MaterialPoint& point) const;  ///< m
  Vec2 velocity(const MaterialPoint& point) const;      ///< m/s, of the half step
  void add_force(const MaterialPoint& point, Vec2 load);

  struct Speeds {
    double largest = 0;   ///< m/s, of a corner; NaN if any is
    double relative = 0;  ///< m/s, bound of the difference between any two corners
    double stray = 0;     ///< m/s, the most by which a corner differs from its drift

    /// m/s, bound of what each of two corners does to close a gap between them, in the frame that shares it.
    double closing() const { return std::min(largest, relative / 2); }
  };
};

/// Of the point of a body that moves as a whole.
Vec2 displacement(const BodyMotion& motion, Vec2 reference);
Vec2 velocity(const BodyVelocity& motion, Vec2 reference);
inline Vec2 velocity(const BodyMotion& motion, Vec2 reference) {
  return velocity(BodyVelocity{motion.velocity, motion.rate}, reference);
}

/// Tangents and lengths of the sides of a ring from its corners.
void measure_sides(std::span<BoundaryCorner> ring);

/// Of an element of any body that deforms.
inline Matrix2 gradient_of_element(const Model& model, const MotionState& motion, std::uint32_t element) {
  const std::uint32_t body = model.element_body[element];
  return model.covered(body) ? gradient(model.elements[element], motion.patch_displacement)
                             : motion.bodies[body].h;
}

/// ΣF r × F of a body force about the displaced centroid, N.
inline double torque(const BodyMotion& motion, const BodyForce& force) {
  const Matrix2 &h = motion.h, &q = force.moment;
  return (1 + h.xx) * q.yx + h.xy * q.yy - h.yx * q.xx - (1 + h.yy) * q.xy;
}

/// Along the cosine and the sine of the rotation of the polar decomposition of I + H.
inline Vec2 turn_of(const Matrix2& h) {
  return {2 + h.xx + h.yy, h.yx - h.xy};
}

/// R − I, R the rotation of the polar decomposition of I + H.
Matrix2 rotation_of(const Matrix2& h);

}  // namespace talus
