#include "model/space_filling.hpp"

#include <algorithm>
#include <utility>

namespace talus {
namespace {

constexpr std::uint32_t bits = 16;

/// Hilbert's curve by quadrants: each is a turned or mirrored copy of the whole.
std::uint64_t place_on_curve(std::uint32_t x, std::uint32_t y) {
  std::uint64_t place = 0;
  for (std::uint32_t side = 1u << (bits - 1); side > 0; side /= 2) {
    const bool right = (x & side) != 0, upper = (y & side) != 0;
    place = 4 * place + (right ? (upper ? 2 : 3) : (upper ? 1 : 0));
    x &= side - 1;
    y &= side - 1;
    if (upper) continue;
    if (right) {
      x = side - 1 - x;
      y = side - 1 - y;
    }
    std::swap(x, y);
  }
  return place;
}

}  // namespace

std::vector<std::uint64_t> along_curve(const std::vector<Vec2>& points) {
  std::vector<std::uint64_t> places;
  if (points.empty()) return places;
  Vec2 low = points[0], high = points[0];
  for (const Vec2 p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const double side = std::max(high.x - low.x, high.y - low.y);
  const double scale = side > 0 ? ((1u << bits) - 1) / side : 0;
  places.reserve(points.size());
  for (const Vec2 p : points) {
    places.push_back(place_on_curve(static_cast<std::uint32_t>((p.x - low.x) * scale),
                                    static_cast<std::uint32_t>((p.y - low.y) * scale)));
  }
  return places;
}

}  // namespace talus
