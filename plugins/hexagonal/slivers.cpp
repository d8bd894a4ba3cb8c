#include "slivers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace talus::hexagonal {
namespace {

/// The continuation of an element says little about places farther away than this, in hexagons.
constexpr int most_steps = 8;

/// Below this share of a hexagon a row sum is rounding, and the patch cannot be left alone.
constexpr double smallest_share = 1e-14;

double twice_area(Point p, Point q, Point r) {
  return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

/// Shape functions of a triangle (Eq. 14), continued beyond it.
std::array<double, 3> weights_at(const std::array<Point, 3>& corner, Point at) {
  const double whole = twice_area(corner[0], corner[1], corner[2]);
  const double second = twice_area(corner[0], at, corner[2]) / whole;
  const double third = twice_area(corner[0], corner[1], at) / whole;
  return {1 - second - third, second, third};
}

struct Search {
  const Connectivity& connectivity;
  const std::vector<Point>& stars;
  std::vector<std::uint8_t> poor;                       // [patch]
  std::vector<std::uint32_t> first_of, of_patch;        // elements of each patch
  std::vector<std::uint32_t> seen_element, seen_patch;  // by which patch's search, + 1

  std::array<Point, 3> corners(std::uint32_t element) const {
    const auto& patch = connectivity.elements[element].patch;
    return {stars[patch[0]], stars[patch[1]], stars[patch[2]]};
  }

  bool is_good(std::uint32_t element) const {
    const auto& patch = connectivity.elements[element].patch;
    return poor[patch[0]] == 0 && poor[patch[1]] == 0 && poor[patch[2]] == 0;
  }

  /// The square of the distance over that of the side of an element. On a lattice many are alike but for
  /// rounding, which is not to decide: a twin of other size or place would follow others.
  double distance_class(std::uint32_t element, Point from) const {
    const auto [p, q, r] = corners(element);
    const double x = (p.x + q.x + r.x) / 3 - from.x, y = (p.y + q.y + r.y) / 3 - from.y;
    const double side = (q.x - p.x) * (q.x - p.x) + (q.y - p.y) * (q.y - p.y);
    return std::round((x * x + y * y) / (1e-6 * side));
  }

  /// Elements of the patches that have not been seen.
  std::vector<std::uint32_t> elements_of(const std::vector<std::uint32_t>& patches, std::uint32_t stamp) {
    std::vector<std::uint32_t> result;
    for (const std::uint32_t patch : patches) {
      for (std::uint32_t k = first_of[patch]; k < first_of[patch + 1]; ++k) {
        if (seen_element[of_patch[k]] == stamp) continue;
        seen_element[of_patch[k]] = stamp;
        result.push_back(of_patch[k]);
      }
    }
    return result;
  }

  std::vector<std::uint32_t> patches_of(const std::vector<std::uint32_t>& elements, std::uint32_t stamp) {
    std::vector<std::uint32_t> result;
    for (const std::uint32_t element : elements) {
      for (const std::uint32_t patch : connectivity.elements[element].patch) {
        if (seen_patch[patch] == stamp) continue;
        seen_patch[patch] = stamp;
        result.push_back(patch);
      }
    }
    return result;
  }

  /// Good elements connected with the patch, nearest first: those in the fewest steps over shared patches,
  /// and one step beyond, since nearer ones may be there.
  std::vector<std::uint32_t> targets(std::uint32_t patch) {
    const std::uint32_t stamp = patch + 1;
    std::vector<std::uint32_t> found, patches{patch};
    seen_patch[patch] = stamp;
    int last_step = most_steps;
    for (int step = 1; step <= last_step && !patches.empty(); ++step) {
      const std::vector<std::uint32_t> elements = elements_of(patches, stamp);
      const bool first_found = found.empty();
      std::copy_if(elements.begin(), elements.end(), std::back_inserter(found),
                   [&](std::uint32_t element) { return is_good(element); });
      if (first_found && !found.empty()) last_step = std::min(last_step, step + 1);
      patches = patches_of(elements, stamp);
    }
    const Point star = stars[patch];
    std::sort(found.begin(), found.end(), [&](std::uint32_t m, std::uint32_t n) {
      const double to_m = distance_class(m, star), to_n = distance_class(n, star);
      return to_m != to_n ? to_m < to_n : m < n;
    });
    return found;
  }
};

Search prepare(const Connectivity& connectivity, const std::vector<Point>& stars,
               const std::vector<double>& row_sums, double least) {
  Search search{connectivity,
                stars,
                {},
                std::vector<std::uint32_t>(stars.size() + 1, 0),
                {},
                std::vector<std::uint32_t>(connectivity.elements.size(), 0),
                std::vector<std::uint32_t>(stars.size(), 0)};
  for (const double sum : row_sums) search.poor.push_back(sum < least ? 1 : 0);
  for (const auto& element : connectivity.elements) {
    for (const std::uint32_t patch : element.patch) ++search.first_of[patch + 1];
  }
  std::partial_sum(search.first_of.begin(), search.first_of.end(), search.first_of.begin());
  std::vector<std::uint32_t> fill(search.first_of.begin(), search.first_of.end() - 1);
  search.of_patch.resize(search.first_of.back());
  for (std::uint32_t e = 0; e < connectivity.elements.size(); ++e) {
    for (const std::uint32_t patch : connectivity.elements[e].patch) search.of_patch[fill[patch]++] = e;
  }
  return search;
}

/// What a merged patch weighs is spread over the three it follows, and weights beyond a triangle are
/// negative. None may lose more than half of its own, or it would dictate the time step in turn.
bool spread(std::vector<double>& carried, const std::vector<double>& row_sums, const Steadied& steadied) {
  const double amount = row_sums[steadied.patch];
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t patch = steadied.to[k];
    if (carried[patch] + amount * steadied.weights[k] < row_sums[patch] / 2) return false;
  }
  for (std::size_t k = 0; k < 3; ++k) carried[steadied.to[k]] += amount * steadied.weights[k];
  return true;
}

}  // namespace

std::vector<double> row_sums(const Connectivity& connectivity, const Regions& regions,
                             const std::vector<Point>& stars) {
  std::vector<double> sums(stars.size(), 0);
  for (std::size_t e = 0; e < connectivity.elements.size(); ++e) {
    const auto& patch = connectivity.elements[e].patch;
    const std::array<Point, 3> corner{stars[patch[0]], stars[patch[1]], stars[patch[2]]};
    const auto [area, x, y] = moments_about(corner[0], regions.of(e));
    // ∫ w of an affine w is linear in the moments; no division by an area that may be tiny.
    const double whole = twice_area(corner[0], corner[1], corner[2]);
    const Point d1{corner[1].x - corner[0].x, corner[1].y - corner[0].y};
    const Point d2{corner[2].x - corner[0].x, corner[2].y - corner[0].y};
    const double second = (x * d2.y - y * d2.x) / whole, third = (d1.x * y - d1.y * x) / whole;
    sums[patch[0]] += area - second - third;
    sums[patch[1]] += second;
    sums[patch[2]] += third;
  }
  return sums;
}

std::vector<Steadied> steady_slivers(const Connectivity& connectivity, const std::vector<Point>& stars,
                                     const std::vector<double>& row_sums, double full, Slivers treatment,
                                     double share) {
  const double least = full * (treatment == Slivers::keep ? smallest_share : std::max(share, smallest_share));
  Search search = prepare(connectivity, stars, row_sums, least);
  std::vector<double> carried = row_sums;
  std::vector<Steadied> result;
  for (std::uint32_t patch = 0; patch < stars.size(); ++patch) {
    if (search.poor[patch] == 0) continue;
    for (const std::uint32_t element : search.targets(patch)) {
      Steadied steadied{patch, connectivity.elements[element].patch,
                        weights_at(search.corners(element), stars[patch]),
                        std::numeric_limits<double>::infinity()};
      if (treatment == Slivers::mass_scale) {
        steadied.inertia_area = least - row_sums[patch];
      } else if (!spread(carried, row_sums, steadied)) {
        continue;
      }
      result.push_back(steadied);
      break;
    }
  }
  return result;
}

}  // namespace talus::hexagonal
