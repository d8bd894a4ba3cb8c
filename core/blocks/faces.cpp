#include "blocks/faces.hpp"

#include "random/random.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace talus {
namespace {

double distance(Vec2 a, Vec2 b) {
  return std::hypot(b.x - a.x, b.y - a.y);
}

/// Area and first moments of a ring about its first vertex, which keeps the digits of far-away scenes.
struct Moments {
  double area = 0, x = 0, y = 0;
};

Moments moments_of(const Ring& ring, Vec2 about) {
  Moments sum;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i] - about;
    const Vec2 next = ring[(i + 1) % ring.size()], b = next - about;
    const double twice = a.x * b.y - b.x * a.y;
    sum.area += twice / 2;
    sum.x += twice * (a.x + b.x) / 6;
    sum.y += twice * (a.y + b.y) / 6;
  }
  return sum;
}

struct Outline {
  Ring ring;
  std::vector<std::uint32_t> surfaces;  ///< [edge]
};

/// How far off a vertex may be, m, to be left out.
class Slack {
 public:
  Slack(const std::vector<Block>& blocks, double most) : most_(most) {
    for (const Block& block : blocks) {
      const double narrow = share_of_width * width_of(block);
      if (narrow >= most) continue;
      for (const Ring& ring : block.loops) {
        for (const Vec2 vertex : ring) {
          double& kept = narrow_.try_emplace({vertex.x, vertex.y}, narrow).first->second;
          kept = std::min(kept, narrow);
        }
      }
    }
  }

  double at(Vec2 vertex) const {
    const auto found = narrow_.find({vertex.x, vertex.y});
    return found == narrow_.end() ? most_ : found->second;
  }

 private:
  /// A fifth of that by which neighbours may overlap and count as touching, overlapping_bodies.
  static constexpr double share_of_width = 2e-7;

  static double width_of(const Block& block) { return 2 * block.area / perimeter_of(block.loops); }

  double most_;
  std::map<std::pair<double, double>, double> narrow_;  ///< of the vertices of thin blocks
};

/// Of vertices at one place, also where the ring closes, one alone, with the edge that leaves them.
Outline without_repeated(const Outline& all, const Slack& slack) {
  const auto same = [&](Vec2 a, Vec2 b) { return distance(a, b) <= std::min(slack.at(a), slack.at(b)); };
  Outline kept;
  for (std::size_t i = 0; i < all.ring.size(); ++i) {
    if (kept.ring.empty() || !same(kept.ring.back(), all.ring[i])) {
      kept.ring.push_back(all.ring[i]);
      kept.surfaces.push_back(all.surfaces[i]);
    } else {
      kept.surfaces.back() = all.surfaces[i];
    }
  }
  while (kept.ring.size() > 1 && same(kept.ring.back(), kept.ring.front())) {
    kept.ring.pop_back();
    kept.surfaces.pop_back();
  }
  return kept;
}

/// Whether the vertex lies on the way from the one before to the next.
bool is_idle(Vec2 before, Vec2 at, Vec2 after, double tolerance) {
  const double dx = after.x - before.x, dy = after.y - before.y, length = std::hypot(dx, dy);
  if (length <= tolerance) return false;
  const double off = ((at.x - before.x) * dy - (at.y - before.y) * dx) / length;
  const double ahead = (at.x - before.x) * dx + (at.y - before.y) * dy;
  return std::abs(off) <= tolerance && ahead > 0 && ahead < length * length;
}

void drop_idle_vertices_of(Block& block, const Slack& slack) {
  for (std::size_t loop = 0; loop < block.loops.size(); ++loop) {
    const Outline apart = without_repeated({block.loops[loop], block.edge_surface[loop]}, slack);
    Outline kept;
    for (std::size_t i = 0; i < apart.ring.size(); ++i) {
      const bool first = kept.ring.empty(), last = i + 1 == apart.ring.size();
      const Vec2 before = first ? apart.ring.back() : kept.ring.back();
      const Vec2 after = !last ? apart.ring[i + 1] : first ? apart.ring[0] : kept.ring[0];
      const std::uint32_t arriving = first ? apart.surfaces.back() : kept.surfaces.back();
      if (arriving == apart.surfaces[i] && is_idle(before, apart.ring[i], after, slack.at(apart.ring[i])))
        continue;
      kept.ring.push_back(apart.ring[i]);
      kept.surfaces.push_back(apart.surfaces[i]);
    }
    if (kept.ring.size() < 3) continue;
    block.loops[loop] = std::move(kept.ring);
    block.edge_surface[loop] = std::move(kept.surfaces);
  }
}

bool is_convex_quadrilateral(const Block& block) {
  if (block.loops.size() != 1 || block.loops[0].size() != 4) return false;
  const Ring& ring = block.loops[0];
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 a = ring[i], b = ring[(i + 1) % 4], c = ring[(i + 2) % 4];
    if ((b.x - a.x) * (c.y - b.y) <= (b.y - a.y) * (c.x - b.x)) return false;
  }
  return true;
}

/// With the surfaces of their edges, where these are known.
void sort_holes(Block& block) {
  const auto first = [](const Ring& ring) { return std::pair(ring[0].x, ring[0].y); };
  for (std::size_t i = 2; i < block.loops.size(); ++i) {
    for (std::size_t j = i; j > 1 && first(block.loops[j]) < first(block.loops[j - 1]); --j) {
      std::swap(block.loops[j], block.loops[j - 1]);
      if (!block.edge_surface.empty()) std::swap(block.edge_surface[j], block.edge_surface[j - 1]);
    }
  }
}

}  // namespace

void orient(Block& block) {
  Moments all;
  const Vec2 about = block.loops[0][0];
  for (std::size_t loop = 0; loop < block.loops.size(); ++loop) {
    Ring& ring = block.loops[loop];
    if ((signed_area(ring) > 0) != (loop == 0)) std::reverse(ring.begin(), ring.end());
    const auto first = std::min_element(
        ring.begin(), ring.end(), [](Vec2 a, Vec2 b) { return std::tie(a.y, a.x) < std::tie(b.y, b.x); });
    if (loop < block.edge_surface.size()) {
      std::vector<std::uint32_t>& surfaces = block.edge_surface[loop];
      std::rotate(surfaces.begin(), surfaces.begin() + (first - ring.begin()), surfaces.end());
    }
    std::rotate(ring.begin(), first, ring.end());
    const Moments part = moments_of(ring, about);
    all = {all.area + part.area, all.x + part.x, all.y + part.y};
  }
  sort_holes(block);
  block.area = all.area;
  block.centroid = {about.x + all.x / all.area, about.y + all.y / all.area};
}

double perimeter_of(const Loops& loops) {
  double sum = 0;
  for (const Ring& ring : loops) {
    for (std::size_t i = 0; i < ring.size(); ++i) sum += distance(ring[i], ring[(i + 1) % ring.size()]);
  }
  return sum;
}

void sort_blocks(std::vector<Block>& blocks, double same) {
  const auto key = [same](const Block& block) {
    return std::tuple(std::round(block.centroid.x / same), std::round(block.centroid.y / same), block.area);
  };
  std::sort(blocks.begin(), blocks.end(), [&](const Block& a, const Block& b) { return key(a) < key(b); });
}

void drop_idle_vertices(std::vector<Block>& blocks, double most) {
  const Slack slack(blocks, most);
  for (Block& block : blocks) drop_idle_vertices_of(block, slack);
}

void split_quadrilaterals(std::vector<Block>& blocks, double share, std::uint64_t seed, double smallest,
                          double thinnest) {
  const auto is_small = [&](const Ring& half) {
    const double area = signed_area(half);
    return area < all_but_rounding * smallest ||
           2 * area < all_but_rounding * thinnest * perimeter_of({half});
  };
  const std::size_t count = blocks.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (Random::stream(seed, i).share() >= share || !is_convex_quadrilateral(blocks[i])) continue;
    const Ring ring = blocks[i].loops[0];
    const std::vector<std::uint32_t> surfaces = blocks[i].edge_surface[0];
    // Of diagonals that rounding alone tells apart the one from the first vertex.
    const std::size_t a = distance(ring[0], ring[2]) <= distance(ring[1], ring[3]) / all_but_rounding ? 0 : 1;
    const std::size_t b = a + 1, c = a + 2, d = (a + 3) % 4;
    if (is_small({ring[a], ring[b], ring[c]}) || is_small({ring[a], ring[c], ring[d]})) continue;
    blocks[i] = {{{ring[a], ring[b], ring[c]}}, {{surfaces[a], surfaces[b], 0}}, 0, {}};
    blocks.push_back({{{ring[a], ring[c], ring[d]}}, {{0, surfaces[c], surfaces[d]}}, 0, {}});
  }
}

}  // namespace talus
