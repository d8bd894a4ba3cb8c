#include "picture/chart.hpp"

#include "picture/legend.hpp"
#include "picture/palette.hpp"
#include "picture/svg.hpp"
#include "picture/thinned.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace talus {
namespace {

constexpr double chart_width = 720, chart_height = 360;
constexpr double least_left = 84, right = 16, top = 34, bottom = 74;  ///< margins
constexpr double digit_width = 6.9, label_margin = 26;
constexpr std::size_t most_points = 1500;  ///< of a curve: more than a line of print can show

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();

  void include(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// A range that numbers on an axis could not tell apart counts as a single value.
  void make_room() {
    if (!(low <= high)) low = 0, high = 1;
    if (high - low <= 1e-12 * std::max(std::abs(low), std::abs(high)))
      low -= std::max(std::abs(low), 1.0) / 2, high += std::max(std::abs(high), 1.0) / 2;
  }
};

std::string_view colour_of(const Curve& curve) {
  return curve.colour == Curve::ink_colour ? palette::ink
                                           : palette::lines[curve.colour % std::size(palette::lines)];
}

void draw_curve(Svg& svg, const Curve& curve, Range x, Range y, double left) {
  std::vector<Spot> points;
  const Stroke stroke{colour_of(curve), 1.6, curve.dashes};
  for (const std::size_t i : thinned_rows(curve.y, most_points)) {
    if (!std::isfinite(curve.y[i])) {
      svg.line(points, stroke);
      points.clear();
    } else {
      points.push_back(
          {left + (curve.x[i] - x.low) / (x.high - x.low) * (chart_width - left - right),
           chart_height - bottom - (curve.y[i] - y.low) / (y.high - y.low) * (chart_height - top - bottom)});
    }
  }
  svg.line(points, stroke);
}

Legend legend_of(const std::vector<Curve>& curves, double left) {
  std::vector<LegendEntry> entries;
  for (const Curve& curve : curves)
    entries.push_back({curve.label, std::string(colour_of(curve)), std::string(curve.dashes)});
  return {std::move(entries), left, chart_width, chart_height - Legend::below};
}

}  // namespace

std::vector<double> ticks(double low, double high) {
  const double rough = (high - low) / 6, power = std::pow(10, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough) {
      step = factor * power;
      break;
    }
  }
  std::vector<double> values;
  for (double i = std::ceil(low / step); i * step <= high * (1 + 1e-12) + 1e-9 * step; ++i)
    values.push_back(i * step + 0.0);  // no −0
  return values;
}

/// Digits that tell ticks apart, which may lie far from zero.
int digits_of(const std::vector<double>& ticks) {
  if (ticks.size() < 2) return 6;
  const double largest = std::max(std::abs(ticks.front()), std::abs(ticks.back())),
               step = ticks[1] - ticks[0];
  return std::clamp(2 + static_cast<int>(std::ceil(std::log10(largest / step))), 6, 15);
}

std::string chart_svg(const std::string& title, const std::string& x_label, const std::string& y_label,
                      const std::vector<Curve>& curves) {
  Range x, y;
  for (const Curve& curve : curves) {
    for (const double value : curve.x) x.include(value);
    for (const double value : curve.y) y.include(value);
  }
  x.make_room();
  y.make_room();
  const double room = 0.04 * (y.high - y.low);
  y.low -= room;
  y.high += room;

  const std::vector<double> y_ticks = ticks(y.low, y.high), x_ticks = ticks(x.low, x.high);
  std::vector<std::string> y_numbers;
  double left = least_left;
  for (const double value : y_ticks) {
    y_numbers.push_back(fmt::format("{:.{}g}", value, digits_of(y_ticks)));
    left = std::max(left, label_margin + 8 + digit_width * static_cast<double>(y_numbers.back().size()));
  }
  const Legend legend = legend_of(curves, left);
  Svg svg(chart_width, legend.height(), title);
  svg.text({left, 20}, title, Svg::Anchor::start, palette::ink, 14);
  for (std::size_t i = 0; i < y_ticks.size(); ++i) {
    const double at =
        chart_height - bottom - (y_ticks[i] - y.low) / (y.high - y.low) * (chart_height - top - bottom);
    svg.line({{left, at}, {chart_width - right, at}}, {palette::grid, 1});
    svg.text({left - 8, at + 4}, y_numbers[i], Svg::Anchor::end, palette::faint);
  }
  for (const double value : x_ticks) {
    const double at = left + (value - x.low) / (x.high - x.low) * (chart_width - left - right);
    svg.line({{at, chart_height - bottom}, {at, chart_height - bottom + 5}}, {palette::faint, 1});
    svg.text({at, chart_height - bottom + 19}, fmt::format("{:.{}g}", value, digits_of(x_ticks)),
             Svg::Anchor::middle, palette::faint);
  }
  svg.line({{left, top}, {left, chart_height - bottom}, {chart_width - right, chart_height - bottom}},
           {palette::faint, 1});
  svg.text({(left + chart_width - right) / 2, chart_height - bottom + 37}, x_label, Svg::Anchor::middle);
  svg.text({18, (top + chart_height - bottom) / 2}, y_label, Svg::Anchor::middle, palette::ink, 12, -90);
  for (const Curve& curve : curves) draw_curve(svg, curve, x, y, left);
  legend.draw(svg);
  return svg.done();
}

}  // namespace talus
