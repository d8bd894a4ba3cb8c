#include "geometry/outlines.hpp"

#include "geometry/box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace talus {
namespace {

/// Twice the area over the perimeter: between a half and the whole of the thickness of a plate.
double width(const Loops& loops) {
  const Ring& ring = loops[0];
  double perimeter = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
    perimeter += std::hypot(b.x - a.x, b.y - a.y);
  }
  return 2 * std::abs(signed_area(ring)) / perimeter;
}

/// An edge that is not upright, from left to right.
struct Span {
  Vec2 from, to;
  double y(double x) const { return from.y + (to.y - from.y) * ((x - from.x) / (to.x - from.x)); }
};

/// Edges above or below the box, relative to its lower left corner so that far-away scenes lose no digits.
std::vector<Span> spans_of(const Loops& loops, const Box& box) {
  std::vector<Span> spans;
  for (const Ring& ring : loops) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
      if (a.x > b.x) std::swap(a, b);
      if (a.x == b.x || b.x <= box.low.x || a.x >= box.high.x) continue;
      spans.push_back({a - box.low, b - box.low});
    }
  }
  return spans;
}

/// Heights at which the line at x enters and leaves the body, in turn.
void heights(const std::vector<Span>& spans, double x, std::vector<double>& out) {
  out.clear();
  for (const Span& span : spans) {
    if (span.from.x < x && x < span.to.x) out.push_back(span.y(x));
  }
  std::sort(out.begin(), out.end());
}

double common_length(const std::vector<double>& a, const std::vector<double>& b) {
  double length = 0;
  std::size_t i = 0, j = 0;
  while (i + 1 < a.size() && j + 1 < b.size()) {
    length += std::max(0.0, std::min(a[i + 1], b[j + 1]) - std::max(a[i], b[j]));
    (a[i + 1] < b[j + 1] ? i : j) += 2;
  }
  return length;
}

void add_crossing(const Span& a, const Span& b, std::vector<double>& cuts) {
  const double left = std::max(a.from.x, b.from.x), right = std::min(a.to.x, b.to.x);
  if (left >= right) return;
  const double gap_left = a.y(left) - b.y(left), gap_right = a.y(right) - b.y(right);
  if ((gap_left < 0) == (gap_right < 0) || gap_left == gap_right) return;
  cuts.push_back(left + (right - left) * (gap_left / (gap_left - gap_right)));
}

/// Area of the overlap within the box, by upright slabs between vertices and crossings: within a slab the
/// common height is linear, so its middle tells it exactly. Nothing here depends on which of two nearly equal
/// lines is the upper one, so touching bodies come out with rounding only.
double overlap_area(const Loops& first, const Loops& second, const Box& box) {
  const std::vector<Span> a = spans_of(first, box), b = spans_of(second, box);
  const double end = box.high.x - box.low.x;
  std::vector<double> cuts{0, end};
  for (const std::vector<Span>* spans : {&a, &b}) {
    for (const Span& span : *spans) {
      cuts.push_back(span.from.x);
      cuts.push_back(span.to.x);
    }
  }
  for (const Span& span : a) {
    for (const Span& other : b) add_crossing(span, other, cuts);
  }
  std::erase_if(cuts, [&](double x) { return x < 0 || x > end; });
  std::sort(cuts.begin(), cuts.end());
  double area = 0;
  std::vector<double> heights_a, heights_b;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const double middle = (cuts[i] + cuts[i + 1]) / 2;
    heights(a, middle, heights_a);
    heights(b, middle, heights_b);
    area += common_length(heights_a, heights_b) * (cuts[i + 1] - cuts[i]);
  }
  return area;
}

/// What of a line a body takes up, m.
struct Reach {
  double low, high;
};

Reach reach_along(Vec2 direction, const Ring& ring) {
  Reach reach{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Vec2 v : ring) {
    const double at = v.x * direction.x + v.y * direction.y;
    reach = {std::min(reach.low, at), std::max(reach.high, at)};
  }
  return reach;
}

std::vector<Reach> reaches_along(Vec2 direction, const std::vector<const Loops*>& bodies) {
  std::vector<Reach> reaches;
  reaches.reserve(bodies.size());
  for (const Loops* loops : bodies) reaches.push_back(reach_along(direction, (*loops)[0]));
  return reaches;
}

/// Across the longest side.
Vec2 across(const Ring& ring) {
  Vec2 longest{};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()], side = b - a;
    if (std::hypot(side.x, side.y) > std::hypot(longest.x, longest.y)) longest = side;
  }
  const double length = std::hypot(longest.x, longest.y);
  return length > 0 ? Vec2{-longest.y / length, longest.x / length} : Vec2{1, 0};
}

/// Of how many bodies a line meets, the mean.
double crowding(const std::vector<Reach>& reaches) {
  double sum = 0;
  Reach all{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Reach& reach : reaches) {
    sum += reach.high - reach.low;
    all = {std::min(all.low, reach.low), std::max(all.high, reach.high)};
  }
  return sum / (all.high - all.low);
}

/// Along the line on which fewest bodies lie beside each other: a column upwards, a row sideways, slabs
/// across.
std::vector<Reach> least_crowded(const std::vector<const Loops*>& bodies) {
  std::vector<Vec2> directions{{1, 0}, {0, 1}};
  constexpr std::size_t samples = 8;
  for (std::size_t i = 0; i < samples && i < bodies.size(); ++i)
    directions.push_back(across((*bodies[i * bodies.size() / samples])[0]));
  std::vector<Reach> best;
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2 direction : directions) {
    std::vector<Reach> reaches = reaches_along(direction, bodies);
    const double crowded = crowding(reaches);
    if (!(crowded < least) && !best.empty()) continue;
    best = std::move(reaches);
    least = crowded;
  }
  return best;
}

}  // namespace

std::vector<BodyOverlap> overlapping_bodies(const std::vector<const Loops*>& bodies) {
  std::vector<Box> boxes;
  std::vector<double> widths;
  for (const Loops* loops : bodies) {
    boxes.push_back(box_around((*loops)[0]));
    widths.push_back(width(*loops));
  }
  const std::vector<Reach> reach = least_crowded(bodies);
  std::vector<std::size_t> order(bodies.size()), active;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return reach[i].low < reach[j].low; });
  std::vector<BodyOverlap> overlaps;
  for (const std::size_t i : order) {
    std::erase_if(active, [&](std::size_t j) { return reach[j].high <= reach[i].low; });
    for (const std::size_t j : active) {
      const Box common{
          {std::max(boxes[i].low.x, boxes[j].low.x), std::max(boxes[i].low.y, boxes[j].low.y)},
          {std::min(boxes[i].high.x, boxes[j].high.x), std::min(boxes[i].high.y, boxes[j].high.y)}};
      const double tolerance = 1e-6 * std::min(widths[i], widths[j]);
      const Vec2 size = common.high - common.low;
      if (size.x <= tolerance || size.y <= tolerance) continue;
      const double area = overlap_area(*bodies[i], *bodies[j], common);
      if (area > tolerance * std::hypot(size.x, size.y))
        overlaps.push_back({std::min(i, j), std::max(i, j), area});
    }
    active.push_back(i);
  }
  std::sort(overlaps.begin(), overlaps.end(), [](const BodyOverlap& a, const BodyOverlap& b) {
    return std::pair(a.a, a.b) < std::pair(b.a, b.b);
  });
  return overlaps;
}

}  // namespace talus
