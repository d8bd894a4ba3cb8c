#pragma once

#include "connectivity.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace talus::hexagonal {

double twice_area(Point p, Point q, Point r);

/// What patches with little of the body may follow: elements without such patches.
class Targets {
 public:
  /// A patch is poor whose row sum is below `least`, m². There is an element; what is given stays alive.
  Targets(const Connectivity& connectivity, const std::vector<Point>& stars,
          const std::vector<double>& row_sums, double least);

  bool is_poor(std::uint32_t patch) const { return row_sums_[patch] < least_; }

  /// The same of patches that lie alike in the body but for rounding, more of those farther from its middle.
  double distance_from_middle(std::uint32_t patch) const { return distance_class(stars_[patch], middle_); }

  /// Good elements connected with the patch, nearest first: those in the fewest steps over shared patches,
  /// and one step beyond, since nearer ones may be there. Of equals come first those nearer the middle of the
  /// body, then those with more of it: neither the numbers of a lattice nor sides of a body decide.
  std::vector<std::uint32_t> of(std::uint32_t patch);

  std::array<Point, 3> corners(std::uint32_t element) const;

 private:
  bool is_good(std::uint32_t element) const;
  double rounded(double area) const;
  double distance_class(Point p, Point q) const;
  double mass_class(std::uint32_t element) const;
  std::vector<std::uint32_t> unseen_elements(const std::vector<std::uint32_t>& patches, std::uint32_t stamp);
  std::vector<std::uint32_t> unseen_patches(const std::vector<std::uint32_t>& elements, std::uint32_t stamp);

  const Connectivity& connectivity_;
  const std::vector<Point>& stars_;
  const std::vector<double>& row_sums_;
  double least_;
  Point middle_;                                          // of the body's mass
  std::vector<std::uint32_t> first_of_, of_patch_;        // elements of each patch
  std::vector<std::uint32_t> seen_element_, seen_patch_;  // by which patch's search, + 1
};

}  // namespace talus::hexagonal
