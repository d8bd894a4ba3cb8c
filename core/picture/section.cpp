#include "picture/section.hpp"

#include "picture/palette.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus {
namespace {

constexpr double lowest = 160, highest = 900;

}  // namespace

SectionView::SectionView(const std::vector<Vec2>& shown, double width) : width_(width) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Vec2 high{-far, -far};
  low_ = {far, far};
  for (const Vec2 point : shown) {
    low_ = {std::min(low_.x, point.x), std::min(low_.y, point.y)};
    high = {std::max(high.x, point.x), std::max(high.y, point.y)};
  }
  if (shown.empty()) low_ = {0, 0}, high = {1, 1};
  const double wide = std::max(high.x - low_.x, 1e-300), tall = std::max(high.y - low_.y, 1e-300);
  height_ = std::clamp((width - 2 * margin) * tall / wide + 2 * margin, lowest, highest);
  scale_ = std::min((width_ - 2 * margin) / wide, (height_ - 2 * margin) / tall);
  // In the middle of what is left over.
  low_.x -= ((width_ - 2 * margin) / scale_ - wide) / 2;
  low_.y -= ((height_ - 2 * margin) / scale_ - tall) / 2;
}

std::vector<Spot> SectionView::ring(const std::vector<Vec2>& points) const {
  std::vector<Spot> spots;
  for (const Vec2 point : points) spots.push_back(at(point));
  return spots;
}

void SectionView::draw_scale(Svg& svg) const {
  const double room = 140 / scale_, power = std::pow(10, std::floor(std::log10(room)));
  const double length = power * (5 * power <= room ? 5 : 2 * power <= room ? 2 : 1);
  svg.line({{14, 16}, {14 + length * scale_, 16}}, {palette::ink, 2});
  svg.text({14, 32}, fmt::format("{:.6g} m", length), Svg::Anchor::start);
}

}  // namespace talus
