#include "geometry/triangulate.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace talus {

namespace {

using Corners = std::vector<std::uint32_t>;

double turn(Vec2 a, Vec2 b, Vec2 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Loops are joined to one ring by a bridge to each hole; then ears are cut off it.
class EarClipping {
 public:
  explicit EarClipping(const std::vector<std::vector<Vec2>>& loops) {
    for (const std::vector<Vec2>& loop : loops) {
      Corners ring(loop.size());
      std::iota(ring.begin(), ring.end(), static_cast<std::uint32_t>(points_.size()));
      points_.insert(points_.end(), loop.begin(), loop.end());
      rings_.push_back(std::move(ring));
    }
  }

  std::vector<std::array<std::uint32_t, 3>> run() {
    // Holes from the right to the left: then nothing that is not yet joined hides the way to the ring.
    std::sort(rings_.begin() + 1, rings_.end(),
              [this](const Corners& a, const Corners& b) { return rightmost(a) > rightmost(b); });
    while (rings_.size() > 1) join_hole();
    while (rings_[0].size() > 3) cut_ear();
    triangles_.push_back({rings_[0][0], rings_[0][1], rings_[0][2]});
    return std::move(triangles_);
  }

 private:
  Vec2 at(const Corners& ring, std::size_t i) const { return points_[ring[i % ring.size()]]; }

  double rightmost(const Corners& ring) const {
    double right = -std::numeric_limits<double>::infinity();
    for (const std::uint32_t corner : ring) right = std::max(right, points_[corner].x);
    return right;
  }

  bool crosses_an_edge(Vec2 from, Vec2 to) const {
    for (const Corners& ring : rings_) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 a = at(ring, i), b = at(ring, i + 1);
        if (same(a, from) || same(a, to) || same(b, from) || same(b, to)) continue;
        if (turn(a, b, from) * turn(a, b, to) <= 0 && turn(from, to, a) * turn(from, to, b) <= 0) return true;
      }
    }
    return false;
  }

  /// Whether `target` lies inside the angle of the ring at corner i.
  bool inside_corner(const Corners& ring, std::size_t i, Vec2 target) const {
    const Vec2 before = at(ring, i + ring.size() - 1), here = at(ring, i), after = at(ring, i + 1);
    const bool left_of_in = turn(before, here, target) > 0, left_of_out = turn(here, after, target) > 0;
    return turn(before, here, after) > 0 ? left_of_in && left_of_out : left_of_in || left_of_out;
  }

  void join_hole() {
    const Corners hole = rings_[1];
    Corners& ring = rings_[0];
    std::size_t best_ring = 0, best_hole = 0;
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      for (std::size_t j = 0; j < hole.size(); ++j) {
        const Vec2 a = at(ring, i), b = at(hole, j);
        const double distance = (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
        if (distance < best && inside_corner(ring, i, b) && !crosses_an_edge(a, b)) {
          best = distance;
          best_ring = i;
          best_hole = j;
        }
      }
    }
    Corners joined(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(best_ring) + 1);
    for (std::size_t j = 0; j <= hole.size(); ++j) joined.push_back(hole[(best_hole + j) % hole.size()]);
    joined.insert(joined.end(), ring.begin() + static_cast<std::ptrdiff_t>(best_ring), ring.end());
    ring = std::move(joined);
    rings_.erase(rings_.begin() + 1);
  }

  bool is_ear(const Corners& ring, std::size_t i) const {
    const Vec2 a = at(ring, i + ring.size() - 1), b = at(ring, i), c = at(ring, i + 1);
    if (!(turn(a, b, c) > 0)) return false;
    for (const std::uint32_t corner : ring) {
      const Vec2 p = points_[corner];
      if (same(p, a) || same(p, b) || same(p, c)) continue;
      if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
    }
    return true;
  }

  /// Where rounding leaves no clean ear, the flattest corner goes: drawing goes on.
  void cut_ear() {
    Corners& ring = rings_[0];
    std::size_t ear = ring.size();
    for (std::size_t i = 0; i < ring.size() && ear == ring.size(); ++i) {
      if (is_ear(ring, i)) ear = i;
    }
    if (ear == ring.size()) {
      ear = 0;
      double flattest = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const double area = std::abs(turn(at(ring, i + ring.size() - 1), at(ring, i), at(ring, i + 1)));
        if (area < flattest) {
          flattest = area;
          ear = i;
        }
      }
    }
    triangles_.push_back(
        {ring[(ear + ring.size() - 1) % ring.size()], ring[ear], ring[(ear + 1) % ring.size()]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(ear));
  }

  std::vector<Vec2> points_;
  std::vector<Corners> rings_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(const std::vector<std::vector<Vec2>>& loops) {
  return EarClipping(loops).run();
}

}  // namespace talus
