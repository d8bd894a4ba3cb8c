#pragma once

#include <string>
#include <vector>

namespace talus {

struct Curve {
  std::string label;
  std::vector<double> x, y;  ///< gaps where y is no number
  std::size_t colour = 0;    ///< entry of palette::lines, or `ink_colour`
  std::string dashes;        ///< as in stroke-dasharray; "" for a solid line
  static constexpr std::size_t ink_colour = 100;
};

/// Curves over one axis, as an SVG for a paper: 720 by 360, and higher where the legend takes
/// more than one line.
std::string chart_svg(const std::string& title, const std::string& x_label, const std::string& y_label,
                      const std::vector<Curve>& curves);

/// Round numbers at even distances that span a range with some 4 to 8 of them.
std::vector<double> ticks(double low, double high);

}  // namespace talus
