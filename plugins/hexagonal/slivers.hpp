#pragma once

#include "connectivity.hpp"
#include "rings.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace talus::hexagonal {

enum class Slivers { merge, mass_scale, keep };

/// Arguments of CoverSink::steady_patch.
struct Steadied {
  std::uint32_t patch;
  std::array<std::uint32_t, 3> to;
  std::array<double, 3> weights;
  double inertia_area;
};

/// ∫ w dA of each patch over the body, m²: the row sums of the mass matrix (Eq. 17) per density.
std::vector<double> row_sums(const Connectivity& connectivity, const Regions& regions,
                             const std::vector<Point>& stars);

/// What is done about patches whose row sum is less than `share` of that of a full hexagon, `full`, m².
std::vector<Steadied> steady_slivers(const Connectivity& connectivity, const std::vector<Point>& stars,
                                     const std::vector<double>& row_sums, double full, Slivers treatment,
                                     double share);

}  // namespace talus::hexagonal
