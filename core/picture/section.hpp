#pragma once

#include "geometry/vec2.hpp"
#include "picture/svg.hpp"

#include <vector>

namespace talus {

/// A part of the plane on a drawing, with y upwards and one scale for both axes.
class SectionView {
 public:
  /// Shows these points, `width` wide and as high as it takes, within bounds.
  SectionView(const std::vector<Vec2>& shown, double width);

  double width() const { return width_; }
  double height() const { return height_; }
  double units_per_metre() const { return scale_; }
  Spot at(Vec2 point) const {
    return {margin + (point.x - low_.x) * scale_, height_ - margin - (point.y - low_.y) * scale_};
  }
  std::vector<Spot> ring(const std::vector<Vec2>& points) const;

  /// A length of one, two or five times a power of ten metres, upper left.
  void draw_scale(Svg& svg) const;

 private:
  static constexpr double margin = 52;  // arrows of loads find room

  Vec2 low_;
  double width_, height_, scale_;
};

}  // namespace talus
