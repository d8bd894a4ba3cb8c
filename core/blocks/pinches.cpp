#include "blocks/pinches.hpp"

#include "blocks/geos.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace talus {
namespace {

constexpr double share = 0.01;  ///< of the shortest side that meets the point

bool same(Vec2 p, Vec2 q) {
  return p.x == q.x && p.y == q.y;
}

std::optional<std::size_t> vertex_at(const Ring& ring, Vec2 point) {
  const auto found = std::find_if(ring.begin(), ring.end(), [&](Vec2 vertex) { return same(vertex, point); });
  if (found == ring.end()) return std::nullopt;
  return found - ring.begin();
}

Vec2 before(const Ring& ring, std::size_t i) {
  return ring[(i + ring.size() - 1) % ring.size()];
}

Vec2 after(const Ring& ring, std::size_t i) {
  return ring[(i + 1) % ring.size()];
}

/// A ring of another block that has the point, within the hole.
struct Within {
  std::size_t block, loop, vertex;
};

/// The corner of a hole at a point, and the line that cuts it off from the point.
class CutCorner {
 public:
  CutCorner(const Ring& hole, std::size_t vertex, double length)
      : point_(hole[vertex]),
        start_(towards(before(hole, vertex), length)),
        end_(towards(after(hole, vertex), length)) {}

  /// Where the line crosses the way from the point to a neighbour of it.
  Vec2 crossing(Vec2 neighbour) const {
    const Vec2 way = minus(neighbour, point_), line = minus(end_, start_);
    const double along = cross(minus(start_, point_), line) / cross(way, line);
    return {point_.x + along * way.x, point_.y + along * way.y};
  }

  void cut(Ring& ring, std::size_t vertex) const {
    const Vec2 from = crossing(before(ring, vertex)), to = crossing(after(ring, vertex));
    ring[vertex] = from;
    ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(vertex) + 1, to);
  }

 private:
  Vec2 towards(Vec2 neighbour, double length) const {
    const double part = length / size_of(minus(neighbour, point_));
    return {point_.x + part * (neighbour.x - point_.x), point_.y + part * (neighbour.y - point_.y)};
  }

  Vec2 point_, start_, end_;
};

void cut_corner(std::vector<Block>& blocks, std::size_t around, std::size_t hole, Vec2 point,
                const Geos& geos) {
  const Ring ring = blocks[around].loops[hole];
  const std::size_t corner = *vertex_at(ring, point);
  double shortest =
      std::min(size_of(minus(before(ring, corner), point)), size_of(minus(after(ring, corner), point)));
  std::vector<Within> within;
  for (std::size_t block = 0; block < blocks.size(); ++block) {
    if (block == around) continue;
    for (std::size_t loop = 0; loop < blocks[block].loops.size(); ++loop) {
      const Ring& other = blocks[block].loops[loop];
      const std::optional<std::size_t> vertex = vertex_at(other, point);
      if (!vertex || !contains({ring}, geos.point_within(blocks[block].loops), 0)) continue;
      within.push_back({block, loop, *vertex});
      shortest = std::min({shortest, size_of(minus(before(other, *vertex), point)),
                           size_of(minus(after(other, *vertex), point))});
    }
  }
  const CutCorner cut(ring, corner, share * shortest);
  for (const Within& at : within) cut.cut(blocks[at.block].loops[at.loop], at.vertex);
  cut.cut(blocks[around].loops[hole], corner);
}

}  // namespace

std::vector<Vec2> bridge_pinches(std::vector<Block>& blocks, const Geos& geos) {
  std::vector<Vec2> bridged;
  for (std::size_t block = 0; block < blocks.size(); ++block) {
    std::set<std::pair<double, double>> seen;
    for (std::size_t loop = 0; loop < blocks[block].loops.size(); ++loop) {
      for (const Vec2 vertex : Ring(blocks[block].loops[loop])) {
        if (seen.emplace(vertex.x, vertex.y).second || loop == 0) continue;
        cut_corner(blocks, block, loop, vertex, geos);
        bridged.push_back(vertex);
      }
    }
  }
  return bridged;
}

}  // namespace talus
