#pragma once

#include <talus/material.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace talus::conformance {

/// A strip of cells of a lattice, turned by 1.1 rad and strained at random: two rows of corners, bottom and
/// top, with x and y apart. What the elements pull with is added to the forces.
struct SweptStrip {
  static constexpr std::array<double, 4> gradient{2.5, -1.25, 0.5, 3};  ///< 1/m, as LatticeCells::gradient
  static constexpr double area = 1.0 / 16;                              ///< m²

  std::uint32_t cells;
  std::vector<double> x, y, force_x, force_y;

  /// Strains of about `strain`; `wild`: every fifth corner moves by 25 mm more.
  SweptStrip(std::uint32_t count, double strain, bool wild);

  // J/m stored.
  double sweep(const Material& law);
  /// The same cells as a chain of triangles, y beside x or apart.
  double sweep_as_chain(const Material& law, bool beside);
  /// Element by element through evaluate().
  double one_by_one(const Material& law);

 private:
  std::array<std::uint32_t, 3> corners_of(std::uint32_t element) const;
  double sign_of(std::uint32_t element) const { return element < cells ? 1 : -1; }
};

/// Of the forces, N/m; NaN where one is.
double largest_difference(const SweptStrip& p, const SweptStrip& q);

}  // namespace talus::conformance
