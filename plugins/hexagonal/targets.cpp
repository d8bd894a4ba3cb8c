#include "targets.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <tuple>

namespace talus::hexagonal {
namespace {

/// The continuation of an element says little about places farther away than this, in hexagons.
constexpr int most_steps = 8;

Point middle_of(const std::vector<Point>& stars, const std::vector<double>& row_sums) {
  double whole = 0, x = 0, y = 0;
  for (std::size_t patch = 0; patch < stars.size(); ++patch) {
    whole += row_sums[patch];
    x += row_sums[patch] * stars[patch].x;
    y += row_sums[patch] * stars[patch].y;
  }
  return {x / whole, y / whole};
}

}  // namespace

double twice_area(Point p, Point q, Point r) {
  return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

Targets::Targets(const Connectivity& connectivity, const std::vector<Point>& stars,
                 const std::vector<double>& row_sums, double least)
    : connectivity_(connectivity),
      stars_(stars),
      row_sums_(row_sums),
      least_(least),
      middle_(middle_of(stars, row_sums)),
      first_of_(stars.size() + 1, 0),
      seen_element_(connectivity.elements.size(), 0),
      seen_patch_(stars.size(), 0) {
  for (const auto& element : connectivity.elements) {
    for (const std::uint32_t patch : element.patch) ++first_of_[patch + 1];
  }
  std::partial_sum(first_of_.begin(), first_of_.end(), first_of_.begin());
  std::vector<std::uint32_t> fill(first_of_.begin(), first_of_.end() - 1);
  of_patch_.resize(first_of_.back());
  for (std::uint32_t e = 0; e < connectivity.elements.size(); ++e) {
    for (const std::uint32_t patch : connectivity.elements[e].patch) of_patch_[fill[patch]++] = e;
  }
}

std::vector<std::uint32_t> Targets::of(std::uint32_t patch) {
  const std::uint32_t stamp = patch + 1;
  std::vector<std::uint32_t> found, patches{patch};
  seen_patch_[patch] = stamp;
  int last_step = most_steps;
  for (int step = 1; step <= last_step && !patches.empty(); ++step) {
    const std::vector<std::uint32_t> elements = unseen_elements(patches, stamp);
    const bool first_found = found.empty();
    std::copy_if(elements.begin(), elements.end(), std::back_inserter(found),
                 [&](std::uint32_t element) { return is_good(element); });
    if (first_found && !found.empty()) last_step = std::min(last_step, step + 1);
    patches = unseen_patches(elements, stamp);
  }
  std::vector<std::tuple<double, double, double, std::uint32_t>> ranked;
  for (const std::uint32_t element : found) {
    const auto [p, q, r] = corners(element);
    const Point centre{(p.x + q.x + r.x) / 3, (p.y + q.y + r.y) / 3};
    ranked.emplace_back(distance_class(centre, stars_[patch]), distance_class(centre, middle_),
                        -mass_class(element), element);
  }
  std::sort(ranked.begin(), ranked.end());
  std::transform(ranked.begin(), ranked.end(), found.begin(),
                 [](const auto& one) { return std::get<3>(one); });
  return found;
}

std::array<Point, 3> Targets::corners(std::uint32_t element) const {
  const auto& patch = connectivity_.elements[element].patch;
  return {stars_[patch[0]], stars_[patch[1]], stars_[patch[2]]};
}

bool Targets::is_good(std::uint32_t element) const {
  const auto& patch = connectivity_.elements[element].patch;
  return !is_poor(patch[0]) && !is_poor(patch[1]) && !is_poor(patch[2]);
}

/// On a lattice much is alike but for rounding, which is not to decide: a twin of other size or place would
/// follow others.
double Targets::rounded(double area) const {
  const auto [p, q, r] = corners(0);
  return std::round(area / (1e-6 * twice_area(p, q, r)));
}

double Targets::distance_class(Point p, Point q) const {
  return rounded((p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y));
}

double Targets::mass_class(std::uint32_t element) const {
  const auto& patch = connectivity_.elements[element].patch;
  return rounded(row_sums_[patch[0]] + row_sums_[patch[1]] + row_sums_[patch[2]]);
}

std::vector<std::uint32_t> Targets::unseen_elements(const std::vector<std::uint32_t>& patches,
                                                    std::uint32_t stamp) {
  std::vector<std::uint32_t> result;
  for (const std::uint32_t patch : patches) {
    for (std::uint32_t k = first_of_[patch]; k < first_of_[patch + 1]; ++k) {
      if (seen_element_[of_patch_[k]] == stamp) continue;
      seen_element_[of_patch_[k]] = stamp;
      result.push_back(of_patch_[k]);
    }
  }
  return result;
}

std::vector<std::uint32_t> Targets::unseen_patches(const std::vector<std::uint32_t>& elements,
                                                   std::uint32_t stamp) {
  std::vector<std::uint32_t> result;
  for (const std::uint32_t element : elements) {
    for (const std::uint32_t patch : connectivity_.elements[element].patch) {
      if (seen_patch_[patch] == stamp) continue;
      seen_patch_[patch] = stamp;
      result.push_back(patch);
    }
  }
  return result;
}

}  // namespace talus::hexagonal
