#include "blocks/lines.hpp"

#include "random/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace talus {
namespace {

/// Where the box lies along a direction.
struct Span {
  double from, to;
};

Span span_of(const Box& box, Vec2 direction) {
  const double x0 = box.low.x * direction.x, x1 = box.high.x * direction.x;
  const double y0 = box.low.y * direction.y, y1 = box.high.y * direction.y;
  return {std::min(x0, x1) + std::min(y0, y1), std::max(x0, x1) + std::max(y0, y1)};
}

/// m, of a line within a box (Liang–Barsky).
double length_within(Vec2 a, Vec2 b, const Box& box) {
  double from = 0, to = 1;
  const auto cut = [&](double start, double change, double low, double high) {
    if (change == 0) {
      if (start < low || start > high) to = 0;
      return;
    }
    const double at_low = (low - start) / change, at_high = (high - start) / change;
    from = std::max(from, std::min(at_low, at_high));
    to = std::min(to, std::max(at_low, at_high));
  };
  cut(a.x, b.x - a.x, box.low.x, box.high.x);
  cut(a.y, b.y - a.y, box.low.y, box.high.y);
  return std::max(0.0, to - from) * std::hypot(b.x - a.x, b.y - a.y);
}

/// Exact where the angle is a whole multiple of 90°, which sin and cos are not.
Vec2 direction_of(double angle) {
  const double quarters = angle / (std::numbers::pi / 2);
  const double whole = std::round(quarters);
  if (std::abs(quarters - whole) > 1e-14) return {std::cos(angle), std::sin(angle)};
  constexpr Vec2 axes[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  return axes[static_cast<std::size_t>(((static_cast<long>(whole) % 4) + 4) % 4)];
}

double margin_of(const Box& box) {
  return 0.01 * box.size();
}

constexpr double least_filled = 1e-3;

double courses(const Bricks& bricks, const Box& box) {
  return std::ceil(box.height() / (bricks.height + bricks.gap));
}

double per_course(const Bricks& bricks, const Box& box) {
  return std::ceil(box.width() / (bricks.width + bricks.gap)) + 1;
}

double sites_in(const Sites& sites, const Box& box) {
  if (sites.spacing == 0) return sites.count;
  const double row = sites.spacing * std::numbers::sqrt3 / 2;
  return (box.width() / sites.spacing + 2) * (box.height() / row + 2);
}

}  // namespace

void add_joints(const JointSet& set, const Box& box, std::vector<Cut>& cuts) {
  const Vec2 along = direction_of(set.dip), across{-along.y, along.x};
  const Span length = span_of(box, along), breadth = span_of(box, across);
  const double margin = margin_of(box), begin = length.from - margin, end = length.to + margin;
  const auto at = [&](double distance, double place) { return place * along + distance * across; };
  const auto first = static_cast<std::int64_t>(std::floor((breadth.from - set.offset) / set.spacing)) - 1;
  const auto last = static_cast<std::int64_t>(std::ceil((breadth.to - set.offset) / set.spacing)) + 1;
  for (std::int64_t k = first; k <= last; ++k) {
    Random random = Random::stream(set.seed, static_cast<std::uint64_t>(k));
    const double moved = set.jitter * random.between(-1, 1);
    const double distance = set.offset + (static_cast<double>(k) + moved) * set.spacing;
    if (set.persistence == 1) {
      cuts.push_back({{at(distance, begin), at(distance, end)}, set.surface});
      continue;
    }
    const double period = set.gap / (1 - set.persistence), open = period - set.gap;
    const double phase = random.share() * period;
    const double number = std::floor((begin - phase) / period);
    for (std::int64_t i = 0; phase + (number + static_cast<double>(i)) * period < end; ++i) {
      const double from = phase + (number + static_cast<double>(i)) * period;
      cuts.push_back({{at(distance, from), at(distance, from + open)}, set.surface});
    }
  }
}

bool Bricks::in_gap(const Box& box, Vec2 point) const {
  if (gap == 0) return false;
  const double course = (point.y - box.low.y) / (height + gap), number = std::floor(course);
  if ((course - number) * (height + gap) > height) return true;
  const bool shifted = running && std::fmod(number, 2) != 0;
  const double place = (point.x - box.low.x) / (width + gap) + (shifted ? 0.5 : 0);
  return (place - std::floor(place)) * (width + gap) > width;
}

void add_bricks(const Bricks& bricks, const Box& box, std::vector<Cut>& cuts) {
  const auto rows = static_cast<std::int64_t>(courses(bricks, box));
  const auto columns = static_cast<std::int64_t>(per_course(bricks, box));
  const double row_height = bricks.height + bricks.gap, column_width = bricks.width + bricks.gap;
  // Bed joints as one line each, head joints between the two lines that bound the course: without a gap,
  // faces of neighbours then have the same coordinates.
  const double left = box.low.x - margin_of(box), right = box.high.x + margin_of(box);
  for (std::int64_t row = 0; row <= rows; ++row) {
    const double bottom = box.low.y + static_cast<double>(row) * row_height;
    const double top =
        bricks.gap == 0 ? box.low.y + static_cast<double>(row + 1) * row_height : bottom + bricks.height;
    cuts.push_back({{{left, bottom}, {right, bottom}}});
    if (bricks.gap > 0) cuts.push_back({{{left, top}, {right, top}}});
    const double shift = bricks.running && row % 2 == 1 ? 0.5 : 0;
    for (std::int64_t column = 0; column <= columns; ++column) {
      const double x = box.low.x + (static_cast<double>(column) - shift) * column_width;
      cuts.push_back({{{x, bottom}, {x, top}}});
      if (bricks.gap > 0) cuts.push_back({{{x + bricks.width, bottom}, {x + bricks.width, top}}});
    }
  }
}

void add_voronoi(const Sites& sites, const std::vector<Ring>& domain, const Geos& geos,
                 std::vector<Cut>& cuts) {
  const Box box = box_around(domain[0]);
  Random random = Random::stream(sites.seed, 0);
  std::vector<Vec2> points;
  if (sites.spacing == 0) {
    // Points are tried all over the box until enough lie within.
    double area = std::abs(signed_area(domain[0]));
    for (std::size_t i = 1; i < domain.size(); ++i) area -= std::abs(signed_area(domain[i]));
    const double filled = area / (box.width() * box.height());
    if (filled < least_filled) {
      throw std::runtime_error(fmt::format(
          "it fills {:.2g} of the box around it, too little to find points within at random (at least {}): "
          "give a \"spacing\" in place of the \"count\", or divide it",
          filled, least_filled));
    }
    const auto count = static_cast<std::size_t>(sites.count);
    while (points.size() < count) {
      const double x = random.share(), y = random.share();
      const Vec2 point{box.low.x + x * box.width(), box.low.y + y * box.height()};
      if (contains(domain, point, 0)) points.push_back(point);
    }
  } else {
    const double row_height = sites.spacing * std::numbers::sqrt3 / 2, move = sites.jitter * sites.spacing;
    const auto rows = static_cast<std::int64_t>(box.height() / row_height) + 1;
    const auto columns = static_cast<std::int64_t>(box.width() / sites.spacing) + 1;
    for (std::int64_t row = 0; row <= rows; ++row) {
      for (std::int64_t column = 0; column <= columns; ++column) {
        const double x = random.between(-1, 1), y = random.between(-1, 1);
        const double shift = row % 2 == 1 ? 0.5 : 0;
        points.push_back({box.low.x + (static_cast<double>(column) - shift) * sites.spacing + move * x,
                          box.low.y + static_cast<double>(row) * row_height + move * y});
      }
    }
  }
  if (points.size() < 2) return;  // one cell: nothing between cells
  for (std::vector<Vec2>& side : geos.voronoi_sides(points, domain[0])) cuts.push_back({std::move(side)});
}

double lines_of(const JointSet& set, const Box& box) {
  const Vec2 along = direction_of(set.dip);
  const Span breadth = span_of(box, {-along.y, along.x});
  return (breadth.to - breadth.from) / set.spacing + 1;
}

Density density_of(const JointSet& set, const Box& box) {
  const Span length = span_of(box, direction_of(set.dip));
  const double parts =
      set.persistence == 1 ? 1 : (length.to - length.from) * (1 - set.persistence) / set.gap + 1;
  return {lines_of(set, box) * parts, set.persistence / set.spacing};
}

Density density_of(const Bricks& bricks, const Box& box) {
  return {courses(bricks, box) * per_course(bricks, box), 1 / bricks.width + 1 / bricks.height};
}

Density density_of(const Sites& sites, const Box& box) {
  // Sides of Voronoi cells of n points per area have a length of 2 √n per area.
  const double count = sites_in(sites, box);
  return {count, 2 * std::sqrt(count / (box.width() * box.height()))};
}

Density density_of(const std::vector<Cut>& cuts, const Box& box) {
  Density density{0, 0};
  double lines = 0;
  for (const Cut& cut : cuts) {
    for (std::size_t i = 1; i < cut.points.size(); ++i) {
      const double length = length_within(cut.points[i - 1], cut.points[i], box);
      if (length == 0) continue;
      density.length += length;
      ++lines;
    }
  }
  const double area = box.width() * box.height();
  density.length /= area;
  // Lines in all directions cross λ²/π times per area, but no two of them more than once.
  density.pieces =
      lines + std::min(density.length * density.length * area / std::numbers::pi, lines * (lines - 1) / 2);
  return density;
}

double estimated_blocks(const std::vector<Density>& sources, const Box& box) {
  double pieces = 1, crossings = 0, before = 0;
  for (const Density& source : sources) {
    pieces += source.pieces;
    crossings += before * source.length;
    before += source.length;
  }
  return pieces + crossings * box.width() * box.height();
}

}  // namespace talus
