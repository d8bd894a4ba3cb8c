#include "blocks/loose_ends.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace talus {
namespace {

constexpr std::size_t most_ends = 4000;  ///< each is held against all faces

double distance(Vec2 point, Vec2 a, Vec2 b) {
  const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
  const double along = square > 0 ? ((point.x - a.x) * dx + (point.y - a.y) * dy) / square : 0;
  const double share = std::clamp(along, 0.0, 1.0);
  return std::hypot(point.x - a.x - share * dx, point.y - a.y - share * dy);
}

double distance(Vec2 point, const Loops& loops) {
  double least = std::numeric_limits<double>::infinity();
  for (const Ring& ring : loops) {
    for (std::size_t i = 0; i < ring.size(); ++i)
      least = std::min(least, distance(point, ring[i], ring[(i + 1) % ring.size()]));
  }
  return least;
}

bool holds(const Box& box, Vec2 point) {
  return point.x >= box.low.x && point.x <= box.high.x && point.y >= box.low.y && point.y <= box.high.y;
}

}  // namespace

std::vector<LooseEnd> loose_ends(const std::vector<Cut>& cuts, const std::vector<Block>& faces,
                                 double margin) {
  std::vector<LooseEnd> found;
  std::vector<Box> boxes;
  for (const Block& face : faces) boxes.push_back(box_around(face.loops[0]));
  std::size_t ends = 0;
  const auto gap_at = [&](Vec2 point) -> std::optional<double> {
    for (std::size_t i = 0; i < faces.size(); ++i) {
      if (!holds(boxes[i], point) || !contains(faces[i].loops, point, 0)) continue;
      return distance(point, faces[i].loops);
    }
    return std::nullopt;
  };
  for (const Cut& cut : cuts) {
    const Vec2 first = cut.points.front(), last = cut.points.back();
    if (!cut.drawn || (first.x == last.x && first.y == last.y)) continue;
    for (const Vec2 end : {first, last}) {
      if (++ends > most_ends) return found;
      const std::optional<double> gap = gap_at(end);
      if (gap && *gap > margin) found.push_back({end, *gap});
    }
  }
  return found;
}

}  // namespace talus
