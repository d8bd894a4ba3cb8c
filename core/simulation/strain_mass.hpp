#pragma once

#include "model/model.hpp"

namespace talus {

/// The deformation part of the mass of an affine block, as an inner product of rates of H, ⟨P, Q⟩ = tr(P ρJ
/// Qᵀ), with strain `scale` times as heavy (selective mass scaling). In the present shape F = I + H a rate is
/// Ḣ = ω W F + V, W the unit spin, ω the angular momentum over the polar inertia I = ⟨WF, WF⟩ and V what
/// strains in a frame that turns with ω; the kinetic energy is ½ I ω² + ½ s ⟨V, V⟩.
///
/// Lagrange's equations of that energy are V̇ = V̇₁/s in the turning frame, V̇₁ as with s = 1, and torque over
/// inertia as ever. Without the terms of the turning frame a spinning body would be strained by s times its
/// centrifugal force. `turn` is what they do, as a motion of its own.
class StrainMass {
 public:
  StrainMass(const Body& body, double density, const Matrix2& h);

  /// ⟨P, Q⟩ with strain as heavy as it is made.
  double product(const Matrix2& p, const Matrix2& q) const;
  /// Of the acceleration that the forces would give with s = 1.
  Matrix2 acceleration(const Matrix2& unscaled) const;
  /// Carries a rate on by `time` under the terms of the turning frame alone: V is turned back by as much as
  /// its frame turns and slowed by the centrifugal force, all but 1/s of it. Exact but for the sine, keeps ω.
  Matrix2 turned(const Matrix2& rate, double time) const;

 private:
  double inner(const Matrix2& p, const Matrix2& q) const;

  double xx_, xy_, yy_;  ///< ρJ
  double scale_;
  Matrix2 shape_, spin_;  ///< F and W F
  double inertia_;
};

}  // namespace talus
