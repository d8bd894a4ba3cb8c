#include "picture/marks.hpp"

#include "picture/legend.hpp"
#include "picture/palette.hpp"
#include "picture/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace talus {
namespace {

constexpr double marks_width = 720, marks_height = 400;
constexpr double marks_left = 84, marks_right = 24, marks_top = 40, marks_bottom = 84;
constexpr double label_size = 10, label_wide = 6.1, label_high = 12;  ///< of a letter; of a line
constexpr double least_span = 0.35;                                   ///< of an axis, in powers of ten
constexpr double many_powers = 2.5;

bool can_be_shown(const Mark& mark) {
  return std::isfinite(mark.x) && std::isfinite(mark.y) && mark.x > 0 && mark.y > 0;
}

/// An axis by powers of ten with a little room at both ends.
class PowerAxis {
 public:
  PowerAxis(const std::vector<Mark>& marks, double Mark::*value, double from, double to)
      : from_(from), to_(to) {
    bool first = true;
    for (const Mark& mark : marks) {
      if (!can_be_shown(mark)) continue;
      const double power = std::log10(mark.*value);
      low_ = first ? power : std::min(low_, power);
      high_ = first ? power : std::max(high_, power);
      first = false;
    }
    const double room = std::max(0.06 * (high_ - low_), (least_span - (high_ - low_)) / 2);
    low_ -= room;
    high_ += room;
  }
  double at(double value) const {
    return from_ + (std::log10(value) - low_) / (high_ - low_) * (to_ - from_);
  }
  std::vector<double> ticks() const { return power_ticks(std::pow(10, low_), std::pow(10, high_)); }

 private:
  double low_ = 0, high_ = 0, from_, to_;
};

struct Box {
  double low_x, low_y, high_x, high_y;

  bool meets(const Box& other) const {
    return low_x < other.high_x && other.low_x < high_x && low_y < other.high_y && other.low_y < high_y;
  }
};

/// Puts labels to the right or the left of their marks, or leaves them out where others stand.
class Labels {
 public:
  explicit Labels(const std::vector<Spot>& spots) {
    for (const Spot spot : spots) taken_.push_back({spot.x - 5, spot.y - 5, spot.x + 5, spot.y + 5});
  }
  void put(Svg& svg, Spot spot, const std::string& words) {
    const double wide = label_wide * static_cast<double>(words.size());
    for (const bool to_right : {true, false}) {
      for (const double up : {-4.0, 12.0}) {
        const double begin = to_right ? spot.x + 8 : spot.x - 8 - wide, base = spot.y + up;
        const Box box{begin, base - label_high + 2, begin + wide, base + 2};
        const bool inside = box.low_x > marks_left && box.high_x < marks_width - 2;
        if (!inside || std::any_of(taken_.begin(), taken_.end(), [&](const Box& b) { return b.meets(box); }))
          continue;
        taken_.push_back(box);
        svg.text({to_right ? begin : spot.x - 8, base}, words,
                 to_right ? Svg::Anchor::start : Svg::Anchor::end, palette::ink, label_size);
        return;
      }
    }
  }

 private:
  std::vector<Box> taken_;
};

void draw_frame(Svg& svg, const PowerAxis& x, const PowerAxis& y) {
  const double floor = marks_height - marks_bottom;
  for (const double value : y.ticks()) {
    svg.line({{marks_left, y.at(value)}, {marks_width - marks_right, y.at(value)}}, {palette::grid, 1});
    svg.text({marks_left - 8, y.at(value) + 4}, fmt::format("{:.3g}", value), Svg::Anchor::end,
             palette::faint);
  }
  for (const double value : x.ticks()) {
    svg.line({{x.at(value), floor}, {x.at(value), marks_top}}, {palette::grid, 1});
    svg.text({x.at(value), floor + 18}, fmt::format("{:.3g}", value), Svg::Anchor::middle, palette::faint);
  }
}

Legend legend_of(const std::vector<MarkLine>& lines) {
  std::vector<LegendEntry> entries;
  for (const MarkLine& line : lines) {
    if (!line.label.empty())
      entries.push_back({line.label, std::string(line.colour), std::string(line.dashes)});
  }
  return {std::move(entries), marks_left, marks_width, marks_height - Legend::below};
}

}  // namespace

std::vector<double> power_ticks(double low, double high) {
  const double span = std::log10(high / low);
  std::vector<double> factors{1, 1.5, 2, 3, 4, 5, 7};
  if (span > 1) factors = {1, 2, 5};
  if (span > many_powers) factors = {1};
  std::vector<double> values;
  for (double power = std::floor(std::log10(low)); power <= std::log10(high); ++power) {
    for (const double factor : factors) {
      const double value = factor * std::pow(10, power);
      if (value >= low && value <= high) values.push_back(value);
    }
  }
  return values;
}

std::string marks_svg(const std::string& title, const std::string& x_label, const std::string& y_label,
                      const std::vector<Mark>& marks, const std::vector<MarkLine>& lines) {
  const Legend legend = legend_of(lines);
  Svg svg(marks_width, legend.height(), title);
  svg.text({marks_left, 22}, title, Svg::Anchor::start, palette::ink, 14);
  if (std::none_of(marks.begin(), marks.end(), can_be_shown)) {
    svg.text({marks_width / 2, marks_height / 2}, "nothing above 0 to show", Svg::Anchor::middle,
             palette::faint);
    return svg.done();
  }
  const auto shown = std::count_if(marks.begin(), marks.end(), can_be_shown);
  if (const auto left_out = static_cast<std::ptrdiff_t>(marks.size()) - shown; left_out > 0) {
    svg.text({marks_width - marks_right, 22},
             fmt::format("{} of {} not drawn: no number above 0", left_out, marks.size()), Svg::Anchor::end,
             palette::faint, 11);
  }
  const PowerAxis x(marks, &Mark::x, marks_left, marks_width - marks_right),
      y(marks, &Mark::y, marks_height - marks_bottom, marks_top);
  const auto spot_of = [&](const Mark& mark) { return Spot{x.at(mark.x), y.at(mark.y)}; };
  draw_frame(svg, x, y);
  svg.text({(marks_left + marks_width - marks_right) / 2, marks_height - marks_bottom + 38}, x_label,
           Svg::Anchor::middle);
  svg.text({18, (marks_top + marks_height - marks_bottom) / 2}, y_label, Svg::Anchor::middle, palette::ink,
           12, -90);
  for (const MarkLine& line : lines) {
    std::vector<Spot> points;
    for (const std::size_t mark : line.marks) {
      if (can_be_shown(marks[mark])) points.push_back(spot_of(marks[mark]));
    }
    svg.line(points, {line.colour, 1.5, line.dashes});
  }
  std::vector<Spot> spots;
  for (const Mark& mark : marks) {
    if (!can_be_shown(mark)) continue;
    spots.push_back(spot_of(mark));
    svg.circle(spots.back(), 4.5, mark.colour, {}, mark.words);
  }
  Labels labels(spots);
  for (const Mark& mark : marks) {
    if (can_be_shown(mark) && !mark.label.empty()) labels.put(svg, spot_of(mark), mark.label);
  }
  legend.draw(svg);
  return svg.done();
}

}  // namespace talus
