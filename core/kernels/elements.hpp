#pragma once

// The loops over elements and patches of bodies of many elements, over plain arrays, so that they can be
// compiled for several instruction sets. Every sum runs in an order that the widths of vectors do not change:
// sums over elements go to eight lanes that are added at the end. Patch vectors (displacement, velocity) are
// stored x, y, x, y, ...; within a subdomain they are LocalVectors.

#include <talus/material.hpp>

#include <cstdint>

namespace talus::kernels {

/// The lanes of a sum: element i goes to lane i mod 8.
inline constexpr std::uint32_t lanes = 8;

/// Vectors of the patches of a subdomain. Apart, x and y have rows of their own (`stride` 1), for lattices,
/// whose cells read rows in packs; beside each other (2) they are for triangles, whose corners are read one
/// by one.
struct LocalVectors {
  double *x, *y;
  std::uint32_t stride;

  bool apart() const { return stride == 1; }
  /// From patch i on.
  LocalVectors from(std::uint32_t i) const { return {x + stride * i, y + stride * i, stride}; }
};

/// v₊ = keep v₋ + gain (f/m + g), and what the energies of the step need.
struct VelocityUpdate {
  double keep, gain;
  double gravity[2];  ///< m/s²
  bool all_sums;      ///< else only that across
};

/// Σ m v₋·v₊, Σ m v₋·v₋, Σ m v₊·v₊, J/m twice over, and Σ m v₋.
struct VelocitySums {
  double across, before, after;
  double momentum[2];
};

struct ElementKernels {
  /// d += dt v of `count` patches, and `at` = d.
  void (*move)(std::uint32_t count, double dt, double* d, const double* v, const LocalVectors& at);

  /// F = I + Σ d_i ⊗ ∇w_i of the lower and upper triangles of `cells` cells side by side. Cell c has the
  /// corners c, c + 1 of the bottom row and of the top row; its lower triangle has the corners bottom c,
  /// bottom c + 1, top c, its upper one the other corner of each. `gradient` are ∇w of the second and third
  /// corner of a lower triangle, 1/m; those of upper ones are opposite. F [component xx, xy, yx, yy]: lower
  /// triangles, then upper ones.
  void (*lattice_gradient)(std::uint32_t cells, const double gradient[4], const double* bottom_x,
                           const double* bottom_y, const double* top_x, const double* top_y,
                           double* const f[4]);

  /// Takes A P ∇w off the forces on both rows (Eq. 18).
  void (*lattice_force)(std::uint32_t cells, const double gradient[4], double area, const double* const p[4],
                        double* bottom_x, double* bottom_y, double* top_x, double* top_y);

  /// The same of a chain: F and P of its triangles, [triangle] without gaps.
  void (*chain_gradient)(const TriangleChain& chain, double* const f[4]);
  void (*chain_force)(const TriangleChain& chain, const double* const p[4]);

  /// Adds ½ (P' + P) : (F − F') to `work` [element], where P' and F' are of a step ago, and puts P and F in
  /// their place.
  void (*work_of_step)(std::uint32_t count, const double* const p[4], const double* const f[4],
                       double* const former_p[4], double* const former_f[4], double* work);

  /// Σ value, and Σ area value of the triangles of a chain.
  double (*sum)(std::uint32_t count, const double* value);
  double (*chain_sum)(const TriangleChain& chain, const double* value);

  /// `mass`, `inverse_mass`: [patch], or of all patches where `same_mass`. `middle`, unless null, takes v₋ +
  /// share (v₊ − v₋). Adds to `sums`.
  void (*accelerate)(std::uint32_t count, const VelocityUpdate& update, bool same_mass, const double* mass,
                     const double* inverse_mass, const LocalVectors& force, double* v, double* middle,
                     double share, VelocitySums& sums);
};

}  // namespace talus::kernels
