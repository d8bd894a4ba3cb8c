#include "blocks/loose_ends.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace talus {
namespace {

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

/// Finds the face that a point lies in, for points from left to right.
class FacesAlong {
 public:
  explicit FacesAlong(const std::vector<Block>& faces) : faces_(faces), order_(faces.size()) {
    for (const Block& face : faces) boxes_.push_back(box_around(face.loops[0]));
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::sort(order_.begin(), order_.end(), [&](std::size_t p, std::size_t q) {
      return std::pair(boxes_[p].low.x, p) < std::pair(boxes_[q].low.x, q);
    });
  }

  const Block* face_at(Vec2 point) {
    while (begun_ < order_.size() && boxes_[order_[begun_]].low.x <= point.x)
      open_.push_back(order_[begun_++]);
    std::erase_if(open_, [&](std::size_t face) { return boxes_[face].high.x < point.x; });
    const Block* found = nullptr;
    for (const std::size_t face : open_) {
      const Box& box = boxes_[face];
      if (point.y < box.low.y || point.y > box.high.y || (found && found < &faces_[face])) continue;
      if (contains(faces_[face].loops, point, 0)) found = &faces_[face];
    }
    return found;
  }

 private:
  const std::vector<Block>& faces_;
  std::vector<Box> boxes_;
  std::vector<std::size_t> order_, open_;
  std::size_t begun_ = 0;
};

}  // namespace

std::vector<LooseEnd> loose_ends(const std::vector<Cut>& cuts, const std::vector<Block>& faces,
                                 double margin) {
  std::vector<Vec2> ends;
  for (const Cut& cut : cuts) {
    const Vec2 first = cut.points.front(), last = cut.points.back();
    if (!cut.drawn || (first.x == last.x && first.y == last.y)) continue;
    ends.insert(ends.end(), {first, last});
  }
  std::vector<std::size_t> order(ends.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t p, std::size_t q) { return std::pair(ends[p].x, p) < std::pair(ends[q].x, q); });
  FacesAlong along(faces);
  std::vector<double> gaps(ends.size(), 0);
  for (const std::size_t end : order) {
    if (const Block* face = along.face_at(ends[end])) gaps[end] = distance(ends[end], face->loops);
  }
  std::vector<LooseEnd> found;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (gaps[i] > margin) found.push_back({ends[i], gaps[i]});
  }
  return found;
}

}  // namespace talus
