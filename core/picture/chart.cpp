#include "picture/chart.hpp"

#include "picture/palette.hpp"
#include "picture/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus {
namespace {

constexpr double chart_width = 720, chart_height = 360;
constexpr double left = 84, right = 16, top = 34, bottom = 74;  ///< margins
constexpr double first_legend_row = chart_height - 14, legend_row = 18;
constexpr std::size_t most_points = 1500;  ///< of a curve: more than a line of print can show

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();

  void include(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  void make_room() {
    if (!(low <= high)) low = 0, high = 1;
    if (low == high) low -= std::max(std::abs(low), 1.0) / 2, high += std::max(std::abs(high), 1.0) / 2;
  }
};

std::string_view colour_of(const Curve& curve) {
  return curve.colour == Curve::ink_colour ? palette::ink
                                           : palette::lines[curve.colour % std::size(palette::lines)];
}

void draw_curve(Svg& svg, const Curve& curve, Range x, Range y) {
  const std::size_t every = std::max<std::size_t>(1, curve.x.size() / most_points);
  std::vector<Spot> points;
  const Stroke stroke{colour_of(curve), 1.6, curve.dashes};
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (!std::isfinite(curve.y[i])) {
      svg.line(points, stroke);
      points.clear();
    } else if (i % every == 0 || i + 1 == curve.x.size()) {
      points.push_back(
          {left + (curve.x[i] - x.low) / (x.high - x.low) * (chart_width - left - right),
           chart_height - bottom - (curve.y[i] - y.low) / (y.high - y.low) * (chart_height - top - bottom)});
    }
  }
  svg.line(points, stroke);
}

/// [curve] where its sample begins: as many in a line as there is room for.
std::vector<Spot> places_in_legend(const std::vector<Curve>& curves) {
  std::vector<Spot> places;
  Spot at{left, first_legend_row};
  for (const Curve& curve : curves) {
    const double wide = 40 + 7.2 * static_cast<double>(curve.label.size());
    if (at.x > left && at.x + wide > chart_width) at = {left, at.y + legend_row};
    places.push_back(at);
    at.x += wide;
  }
  return places;
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

  const std::vector<Spot> legend = places_in_legend(curves);
  const double height = (legend.empty() ? first_legend_row : legend.back().y) + legend_row - 4;
  Svg svg(chart_width, height, title);
  svg.text({left, 20}, title, Svg::Anchor::start, palette::ink, 14);
  const std::vector<double> y_ticks = ticks(y.low, y.high), x_ticks = ticks(x.low, x.high);
  for (const double value : y_ticks) {
    const double at =
        chart_height - bottom - (value - y.low) / (y.high - y.low) * (chart_height - top - bottom);
    svg.line({{left, at}, {chart_width - right, at}}, {palette::grid, 1});
    svg.text({left - 8, at + 4}, fmt::format("{:.{}g}", value, digits_of(y_ticks)), Svg::Anchor::end,
             palette::faint);
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
  for (const Curve& curve : curves) draw_curve(svg, curve, x, y);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const Spot at = legend[i];
    svg.line({at, {at.x + 22, at.y}}, {colour_of(curves[i]), 2, curves[i].dashes});
    svg.text({at.x + 28, at.y + 4}, curves[i].label, Svg::Anchor::start);
  }
  return svg.done();
}

}  // namespace talus
