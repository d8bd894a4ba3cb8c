#include "blocks/loose_ends.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace talus {
namespace {

bool holds(const Box& box, Vec2 point) {
  return point.x >= box.low.x && point.x <= box.high.x && point.y >= box.low.y && point.y <= box.high.y;
}

/// Of a point to the nearest of a box.
double distance(Vec2 point, const Box& box) {
  return std::hypot(std::max({box.low.x - point.x, point.x - box.high.x, 0.0}),
                    std::max({box.low.y - point.y, point.y - box.high.y, 0.0}));
}

/// A face with boxes around its loops: it may have thousands of them, of which few are near a point.
struct BoxedFace {
  const Loops& loops;
  std::vector<Box> boxes;

  explicit BoxedFace(const Block& face) : loops(face.loops) {
    for (const Ring& ring : loops) boxes.push_back(box_around(ring));
  }

  bool has(Vec2 point) const {
    if (!holds(boxes[0], point) || !contains({loops[0]}, point, 0)) return false;
    for (std::size_t hole = 1; hole < loops.size(); ++hole) {
      if (holds(boxes[hole], point) && contains({loops[hole]}, point, 0)) return false;
    }
    return true;
  }

  double gap(Vec2 point) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t loop = 0; loop < loops.size(); ++loop) {
      const Ring& ring = loops[loop];
      if (distance(point, boxes[loop]) >= least) continue;
      for (std::size_t i = 0; i < ring.size(); ++i)
        least = std::min(least, distance_from(point, ring[i], ring[(i + 1) % ring.size()]));
    }
    return least;
  }
};

/// Finds the face that a point lies in, for points from left to right.
class FacesAlong {
 public:
  explicit FacesAlong(const std::vector<Block>& faces) : order_(faces.size()) {
    for (const Block& face : faces) faces_.emplace_back(face);
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::sort(order_.begin(), order_.end(), [&](std::size_t p, std::size_t q) {
      return std::pair(box_of(p).low.x, p) < std::pair(box_of(q).low.x, q);
    });
  }

  const BoxedFace* face_at(Vec2 point) {
    while (begun_ < order_.size() && box_of(order_[begun_]).low.x <= point.x)
      open_.push_back(order_[begun_++]);
    std::erase_if(open_, [&](std::size_t face) { return box_of(face).high.x < point.x; });
    const BoxedFace* found = nullptr;
    for (const std::size_t face : open_) {
      if ((found == nullptr || &faces_[face] < found) && faces_[face].has(point)) found = &faces_[face];
    }
    return found;
  }

 private:
  const Box& box_of(std::size_t face) const { return faces_[face].boxes[0]; }

  std::vector<BoxedFace> faces_;
  std::vector<std::size_t> order_, open_;
  std::size_t begun_ = 0;
};

/// To the nearest line, `most` if none is nearer. Few of many lines are looked at where one is near.
double gap_to_lines(const LineEnd& end, const SidesByPlace& sides, double reach, double most) {
  double least = most;
  for (double radius = reach; least == most; radius *= 8) {
    sides.each_near(end, std::min(radius, most),
                    [&](const LineSide&, double distance) { least = std::min(least, distance); });
    if (radius >= most) break;
  }
  return least;
}

}  // namespace

std::vector<LooseEnd> loose_ends(const std::vector<LineEnd>& ends, const std::vector<Block>& faces,
                                 const SidesByPlace& sides, double reach) {
  std::vector<std::size_t> order(ends.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t p, std::size_t q) {
    return std::pair(ends[p].at.x, p) < std::pair(ends[q].at.x, q);
  });
  FacesAlong along(faces);
  std::vector<double> gaps(ends.size(), 0);
  for (const std::size_t end : order) {
    if (const BoxedFace* face = along.face_at(ends[end].at))
      gaps[end] = gap_to_lines(ends[end], sides, reach, face->gap(ends[end].at));
  }
  std::vector<LooseEnd> found;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (gaps[i] > reach) found.push_back({ends[i].at, gaps[i]});
  }
  return found;
}

}  // namespace talus
