#pragma once

#include <cstdint>

namespace talus {

/// Deformation of a range of elements at t_n. Component order xx, xy, yx, yy; arrays of length `count`.
struct MaterialBatch {
  const double* deformation[4];           ///< F = I + ∂u/∂X at t_n
  const double* previous_deformation[4];  ///< F at t_{n-1}; anything where the material does not need it
  const double* state;                    ///< [element * doubles_per_element] as left at t_{n-1}
  /// s. Of a law without state that needs no previous deformation the response must not depend on it: such a
  /// law is asked for stress outside of steps, too, where output wants it.
  double dt;
  std::uint32_t count;
};

struct MaterialResponse {
  double* stress[4];  ///< Pa, first Piola–Kirchhoff P (force per reference area), P_iJ as F_iJ
  /// Pa, of it what goes with the rate of strain. The host books its work, half on the step behind and half
  /// on the one ahead. Left alone where viscous_time() is 0.
  double* viscous_stress[4];
  double* energy;      ///< J/m³ of reference volume, recoverable
  double* dissipated;  ///< J/m³ since t_{n-1}, besides the work of viscous stress
  double* state;       ///< of t_n; separate from MaterialBatch::state
};

/// Two rows in memory that the host reads on from after a sweep: fetched along the way, they are there in
/// time.
struct RowsAhead {
  const double* from[2];
};

/// Cells of a regular lattice side by side, each a lower and an upper triangle. Cell c has the corners c, c +
/// 1 of the bottom row and of the top row; its lower triangle has the corners bottom c, bottom c + 1, top c,
/// its upper one the other corner of each.
struct LatticeCells {
  std::uint32_t count;
  double gradient[4];  ///< 1/m, ∇w of the second corner of a lower triangle x, y, and of the third; an upper
                       ///< one has the opposite
  double area;                                        ///< m², of a triangle
  const double *bottom_x, *bottom_y, *top_x, *top_y;  ///< [count + 1] m, displacement
  double *bottom_force_x, *bottom_force_y;            ///< [count + 1] N/m
  double *top_force_x, *top_force_y;                  ///< [count + 1] N/m
  RowsAhead ahead;
};

/// Triangles of any shape, in a chain: link i makes a triangle of the corners of links i − 2, i − 1 and i,
/// its first, second and third, so that of most triangles two corners are at hand already. Where a strip of
/// triangles turns or ends there are links without triangle, whose gradient and area are 0: so are the first
/// two, the last `links_after`, and `links_before` more before link 0, of which `corner` alone is read.
struct TriangleChain {
  static constexpr std::uint32_t links_before = 2, links_after = 2, multiple = 8;

  std::uint32_t count;          ///< of links, a multiple of `multiple`
  std::uint32_t beside;         ///< 1: y of a corner lies beside its x; 0: in a row of its own
  const std::uint32_t* corner;  ///< [link] which entry of x and of y it is
  const double* gradient[4];    ///< [link] 1/m, ∇w of the second corner x, y, and of the third
  const double* area;           ///< [link] m²
  const double *x, *y;          ///< m, displacement
  double *force_x, *force_y;    ///< N/m
  RowsAhead ahead;
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
  /// proportional damping. For the time step. Above 0 the host keeps former deformation and viscous stress.
  virtual double viscous_time() const noexcept { return 0; }

  /// Whether evaluate() reads previous_deformation. A material that says no spares the host to keep it for
  /// every element.
  virtual bool needs_previous_deformation() const noexcept { return true; }

  /// Whether the material takes elements from displacements to forces itself, by the two calls below. They
  /// then stand for evaluate() in bodies of many elements, to which they are equal but for rounding, at
  /// several times the speed: what lies between stays in registers (`talus/elements/sweep.hpp` has the
  /// loops). For laws without state that dissipate nothing and need no previous deformation.
  virtual bool sweeps() const noexcept { return false; }

  /// Takes area · P ∇w off the forces of the corners (Eq. 18) and returns what the elements store, J/m. The
  /// bits may depend on how elements are grouped into calls, and on nothing else.
  virtual double sweep(const LatticeCells& /*cells*/) const noexcept { return 0; }
  virtual double sweep(const TriangleChain& /*triangles*/) const noexcept { return 0; }
};

}  // namespace talus
