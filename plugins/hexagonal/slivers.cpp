#include "slivers.hpp"

#include "targets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace talus::hexagonal {
namespace {

/// Below this share of a hexagon a row sum is rounding, and the patch cannot be left alone.
constexpr double smallest_share = 1e-14;

/// Shape functions of an element (Eq. 14), continued to another vertex of the lattice: whole numbers.
std::array<double, 3> weights_at(const std::array<Point, 3>& corner, Point at) {
  const double whole = twice_area(corner[0], corner[1], corner[2]);
  const double second = std::round(twice_area(corner[0], at, corner[2]) / whole);
  const double third = std::round(twice_area(corner[0], corner[1], at) / whole);
  return {1 - second - third, second, third};
}

/// What a patch may follow, the best first.
struct Choices {
  std::vector<Steadied> all;
  std::size_t next = 0;

  const Steadied& asked() const { return all[next]; }
};

/// What a merged patch weighs is spread over the three it follows, and weights beyond a triangle are
/// negative. None may lose more than half of its own, or it would dictate the time step in turn: those who
/// together take too much of one follow what is next for them.
class Spread {
 public:
  explicit Spread(const std::vector<double>& row_sums) : row_sums_(row_sums), carried_(row_sums) {}

  /// Patches that lie alike in the body: none comes before another.
  void add(std::vector<Choices> waiting) {
    while (!waiting.empty()) serve(waiting);
  }

  /// In the order of patches.
  std::vector<Steadied> result() && {
    std::sort(result_.begin(), result_.end(),
              [](const Steadied& one, const Steadied& other) { return one.patch < other.patch; });
    return std::move(result_);
  }

 private:
  /// Those leave that get what they ask for, and those that have nothing left to ask for.
  void serve(std::vector<Choices>& waiting) {
    std::erase_if(waiting, [](const Choices& one) { return one.next == one.all.size(); });
    std::map<std::uint32_t, double> taken;
    for (const Choices& one : waiting) {
      const Steadied& asked = one.asked();
      for (std::size_t k = 0; k < 3; ++k) taken[asked.to[k]] += std::fmin(load(asked, k), 0);
    }
    const auto left = std::stable_partition(waiting.begin(), waiting.end(), [&](const Choices& one) {
      return !takes_too_much(one.asked(), taken);
    });
    for (auto one = waiting.begin(); one != left; ++one) {
      for (std::size_t k = 0; k < 3; ++k) carried_[one->asked().to[k]] += load(one->asked(), k);
      result_.push_back(one->asked());
    }
    waiting.erase(waiting.begin(), left);
    for (Choices& one : waiting) ++one.next;
  }

  double load(const Steadied& one, std::size_t k) const { return row_sums_[one.patch] * one.weights[k]; }

  bool takes_too_much(const Steadied& one, const std::map<std::uint32_t, double>& taken) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t patch = one.to[k];
      if (load(one, k) < 0 && carried_[patch] + taken.at(patch) < row_sums_[patch] / 2) return true;
    }
    return false;
  }

  const std::vector<double>& row_sums_;
  std::vector<double> carried_;
  std::vector<Steadied> result_;
};

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
  Targets targets(connectivity, stars, row_sums, least);
  std::map<double, std::vector<Choices>> alike;  // by the distance from the middle of the body
  std::vector<Steadied> scaled;
  for (std::uint32_t patch = 0; patch < stars.size(); ++patch) {
    if (!targets.is_poor(patch)) continue;
    const double inertia_area =
        treatment == Slivers::mass_scale ? least - row_sums[patch] : std::numeric_limits<double>::infinity();
    Choices choices;
    for (const std::uint32_t element : targets.of(patch)) {
      choices.all.push_back({patch, connectivity.elements[element].patch,
                             weights_at(targets.corners(element), stars[patch]), inertia_area});
    }
    if (treatment != Slivers::mass_scale) {
      alike[targets.distance_from_middle(patch)].push_back(std::move(choices));
    } else if (!choices.all.empty()) {
      scaled.push_back(choices.asked());
    }
  }
  if (treatment == Slivers::mass_scale) return scaled;
  Spread spread(row_sums);
  for (auto& [distance, choices] : alike) spread.add(std::move(choices));
  return std::move(spread).result();
}

}  // namespace talus::hexagonal
