#pragma once

#include "conformance/recorded_cover.hpp"

namespace talus::covered {

using namespace conformance;

constexpr double merge = 0, mass_scale = 1, keep = 2;  ///< what becomes of slivers

struct Settings {
  double size;
  Point vertex{0, 0};  ///< of the lattice, in the coordinates that the body was drawn in
  double angle = 0;    ///< degrees
  double slivers = 0;  ///< 0 merge, 1 mass_scale, 2 keep
  double sliver_share = 0.1;
};

RecordedCover lay(const DrawnBody& body, const Settings& settings);

std::vector<double> row_sums(const RecordedCover& cover);  ///< [patch] ∫ w dA, m²
double outline_length(const DrawnBody& body);
double boundary_length(const RecordedCover& cover);
bool segments_cross(Point p, Point q, Point r, Point s);
Line reversed(Line line);

/// Everything that holds for any cover of any body. What is on a line in the cover may be off that line by
/// `snap` sizes; the finest tolerance of the lattice is 2e-9 of the size.
void check_cover(const DrawnBody& body, const RecordedCover& cover, double size, double snap = 1e-8);

}  // namespace talus::covered
