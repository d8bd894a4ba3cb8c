#include "model/distinct_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace talus {
namespace {

/// Of a patch that a point does not hang on, but for rounding or for what a cover takes for a coincidence.
constexpr double no_weight = 2e-7;

/// The patches that a point hangs on, rising; behind them no_patch.
std::array<std::uint32_t, 3> patches_of(const Carrier& carrier) {
  std::array<std::uint32_t, 3> patches = carrier.patch;
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::abs(carrier.weight[i]) < no_weight) patches[i] = no_patch;
  }
  std::sort(patches.begin(), patches.end());
  return patches;
}

struct Known {
  Vec2 at;
  std::array<std::uint32_t, 3> patches;
  std::uint32_t before;  ///< the last one known before it that has the same first patch
};

}  // namespace

std::vector<std::uint32_t> distinct_points(const Model& model, std::uint32_t body) {
  const Body& b = model.bodies[body];
  const CoverRanges& ranges = model.ranges(b);
  constexpr std::uint32_t none = 0xFFFFFFFFu;
  std::vector<Known> known;
  std::vector<std::uint32_t> latest(ranges.patch_end - ranges.patch_begin, none);  ///< [patch] in `known`
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t i = b.element_begin; i < b.element_end; ++i) {
    const std::uint32_t element = model.body_element[i];
    for (const Ring& ring : model.element_region[element]) {
      for (const Vec2 at : ring) {
        const std::array<std::uint32_t, 3> patches = patches_of(model.carrier(model.elements[element], at));
        std::uint32_t& last = latest[patches[0] - ranges.patch_begin];
        std::uint32_t number = last;
        const auto same = [&](const Known& other) {
          return other.at.x == at.x && other.at.y == at.y && other.patches == patches;
        };
        while (number != none && !same(known[number])) number = known[number].before;
        if (number == none) {
          number = static_cast<std::uint32_t>(known.size());
          known.push_back({at, patches, last});
          last = number;
        }
        numbers.push_back(number);
      }
    }
  }
  return numbers;
}

}  // namespace talus
