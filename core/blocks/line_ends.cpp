#include "blocks/line_ends.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace talus {
namespace {

/// Times the reach, that ends are led ahead at most: half a degree off a line that is missed by the reach.
constexpr double farthest_ahead = 100;
/// Of the reach, within which lengthened lines meet whatever rounding does.
constexpr double surely = 0.9;

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<LineSide> sides_of_lines(const std::vector<Cut>& cuts, const Block& domain) {
  std::vector<LineSide> sides;
  for (std::size_t line = 0; line < cuts.size(); ++line) {
    const std::vector<Vec2>& points = cuts[line].points;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) sides.push_back({line, i, points[i], points[i + 1]});
  }
  for (std::size_t loop = 0; loop < domain.loops.size(); ++loop) {
    const Ring& ring = domain.loops[loop];
    for (std::size_t i = 0; i < ring.size(); ++i)
      sides.push_back({cuts.size() + loop, i, ring[i], ring[(i + 1) % ring.size()]});
  }
  return sides;
}

std::vector<PlainSegment> segments_of(const std::vector<LineSide>& sides) {
  std::vector<PlainSegment> segments;
  for (const LineSide& side : sides) segments.push_back({side.from, side.to});
  return segments;
}

Vec2 ahead_of(const LineEnd& end) {
  const Vec2 way = end.at - end.before;
  const double length = size_of(way);
  return way / length;
}

/// How far ahead of the end its line crosses a segment, m; negative behind it.
std::optional<double> crossing_ahead(const LineEnd& end, Vec2 from, Vec2 to) {
  const Vec2 ahead = ahead_of(end), side = to - from, way = from - end.at;
  const double sine = cross(ahead, side);
  if (sine == 0) return std::nullopt;
  const double share = cross(way, ahead) / sine;
  if (share < 0 || share > 1) return std::nullopt;
  return cross(way, side) / sine;
}

Vec2 nearest_on(const LineSide& side, Vec2 point) {
  const Vec2 span = side.to - side.from;
  const double square = dot(span, span);
  if (square == 0) return side.from;
  const double share = std::clamp(dot(point - side.from, span) / square, 0.0, 1.0);
  if (share == 1) return side.to;
  return side.from + share * span;
}

/// Whether a side begins where the line ends and lies along it, and so leads no farther.
bool runs_back(const LineEnd& end, const LineSide& side, double reach) {
  const bool at_start = size_of(side.from - end.at) < size_of(side.to - end.at);
  const Vec2 start = at_start ? side.from : side.to;
  if (size_of(start - end.at) > reach) return false;
  const Vec2 back = end.before - end.at;
  const double length = size_of(back), share = std::min(1.0, size_of(side.to - side.from) / length);
  return distance_from(end.at + share * back, side.from, side.to) <= reach;
}

/// What an end finds of a line about it.
struct Nearby {
  double distance = infinity;
  std::size_t side = 0;  ///< the nearest
  Vec2 foot;             ///< on it
  double ahead = infinity;
  bool met = false;
};

using NearbyLines = std::map<std::size_t, Nearby>;

NearbyLines lines_about(const LineEnd& end, const std::vector<Cut>& cuts, const SidesByPlace& sides,
                        double reach) {
  NearbyLines lines;
  const double farthest = farthest_ahead * reach, back = std::min(farthest, size_of(end.at - end.before) / 2);
  sides.each_near(end, farthest, [&](const LineSide& side, double distance) {
    Nearby& line = lines[side.line];
    if (std::pair(distance, side.number) < std::pair(line.distance, line.side)) {
      line.distance = distance;
      line.side = side.number;
      line.foot = nearest_on(side, end.at);
    }
    // The others are lengthened, too.
    const Vec2 way = side.to - side.from;
    const double share = reach / size_of(way);
    Vec2 from = side.from, to = side.to;
    if (side.line < cuts.size() && side.number == 0) from = from - share * way;
    if (side.line < cuts.size() && side.number + 2 == cuts[side.line].points.size()) to += share * way;
    const std::optional<double> ahead = crossing_ahead(end, from, to);
    if (!ahead || *ahead < -back || *ahead > farthest) return;
    if (*ahead <= surely * reach) line.met = true;
    line.ahead = std::min(line.ahead, *ahead);
  });
  return lines;
}

/// Leads a copy of the line that the end is of on.
void join(const LineEnd& end, const NearbyLines& lines, double reach, Cut& cut) {
  const double rounding = 0x1p-50 * std::max(std::abs(end.at.x), std::abs(end.at.y));
  double ahead = 0;
  const Nearby* nearest = nullptr;
  for (const auto& [number, line] : lines) {
    if (line.distance > reach || line.met) continue;
    if (line.ahead < infinity) {
      ahead = std::max(ahead, line.ahead);
    } else if (line.distance > rounding && (nearest == nullptr || line.distance < nearest->distance)) {
      nearest = &line;
    }
  }
  std::vector<Vec2>& points = cut.points;
  if (ahead > 0) {
    const Vec2 way = ahead_of(end);
    (end.last ? points.back() : points.front()) = end.at + ahead * way;
  } else if (nearest != nullptr) {
    points.insert(end.last ? points.end() : points.begin(), nearest->foot);
  }
}

}  // namespace

std::vector<LineEnd> ends_of(const std::vector<Cut>& cuts) {
  std::vector<LineEnd> ends;
  for (std::size_t line = 0; line < cuts.size(); ++line) {
    const std::vector<Vec2>& points = cuts[line].points;
    const std::size_t last = points.size() - 1;
    if (!cuts[line].drawn || (points[0].x == points[last].x && points[0].y == points[last].y)) continue;
    ends.push_back({line, false, points[0], points[1]});
    ends.push_back({line, true, points[last], points[last - 1]});
  }
  return ends;
}

SidesByPlace::SidesByPlace(const std::vector<Cut>& cuts, const Block& domain, double reach, const Geos& geos)
    : sides_(sides_of_lines(cuts, domain)), reach_(reach), tree_(segments_of(sides_), geos) {
  for (const Cut& cut : cuts) count_.push_back(cut.points.size() - 1);
}

void SidesByPlace::each_near(const LineEnd& end, double distance,
                             const std::function<void(const LineSide&, double)>& take) const {
  const Box box{{end.at.x - distance, end.at.y - distance}, {end.at.x + distance, end.at.y + distance}};
  tree_.each_near(box, [&](std::size_t number) {
    const LineSide& side = sides_[number];
    const std::size_t from_end = end.last ? count_[end.line] - 1 - side.number : side.number;
    if (side.line == end.line && from_end < 2) return;
    const double away = distance_from(end.at, side.from, side.to);
    if (away <= distance && !runs_back(end, side, reach_)) take(side, away);
  });
}

std::vector<Cut> joined_ends(const std::vector<Cut>& cuts, const Block& domain, const SidesByPlace& sides,
                             double reach) {
  std::vector<Cut> joined = cuts;
  const Box box = box_around(domain.loops[0]);
  for (const LineEnd& end : ends_of(cuts)) {
    if (end.at.x < box.low.x - reach || end.at.x > box.high.x + reach || end.at.y < box.low.y - reach ||
        end.at.y > box.high.y + reach)
      continue;
    join(end, lines_about(end, cuts, sides, reach), reach, joined[end.line]);
  }
  return joined;
}

}  // namespace talus
