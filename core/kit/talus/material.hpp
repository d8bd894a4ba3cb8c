#pragma once

#include <cstdint>

namespace talus {

/// Deformation of a range of elements at t_n. Component order xx, xy, yx, yy; arrays of length `count`.
struct MaterialBatch {
  const double* deformation[4];           ///< F = I + ∂u/∂X at t_n
  const double* previous_deformation[4];  ///< F at t_{n-1}; anything where the material does not need it
  const double* state;                    ///< [element * doubles_per_element] as left at t_{n-1}
  double dt;                              ///< s
  std::uint32_t count;
};

struct MaterialResponse {
  double* stress[4];   ///< Pa, first Piola–Kirchhoff P (force per reference area), P_iJ as F_iJ
  double* energy;      ///< J/m³ of reference volume, recoverable
  double* dissipated;  ///< J/m³ since t_{n-1}
  double* state;       ///< of t_n; separate from MaterialBatch::state
};

/// A constitutive law (Eq. 2). Const: all state lives with the host.
class Material {
 public:
  virtual ~Material() = default;

  virtual std::uint32_t doubles_per_element() const noexcept = 0;

  virtual void evaluate(const MaterialBatch& batch, const MaterialResponse& response) const noexcept = 0;

  /// Stiffest tangent the law can show, Pa: 3×3 row-major over (xx, yy, 2·xy). For the time step.
  virtual void stiffest_tangent(double tangent[9]) const noexcept = 0;

  /// Viscous stress over elastic stress at a strain rate of 1 per second, the largest, s: stiffness-
  /// proportional damping. For the time step.
  virtual double viscous_time() const noexcept { return 0; }

  /// Whether evaluate() reads previous_deformation. A material that says no spares the host to keep it for
  /// every element.
  virtual bool needs_previous_deformation() const noexcept { return true; }
};

}  // namespace talus
