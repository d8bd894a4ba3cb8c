#include "blocks/pinches.hpp"

#include "geometry/box.hpp"
#include "geometry/geos.hpp"
#include "geometry/place.hpp"
#include "geometry/polygon.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

namespace talus {
namespace {

constexpr double share = 0.01;    ///< of the shortest side that meets the point
constexpr double flattest = 2.9;  ///< rad, of a corner that can be cut off

std::optional<std::size_t> vertex_at(const Ring& ring, Vec2 point) {
  const auto found = std::find_if(ring.begin(), ring.end(),
                                  [&](Vec2 vertex) { return vertex.x == point.x && vertex.y == point.y; });
  if (found == ring.end()) return std::nullopt;
  return found - ring.begin();
}

Vec2 before(const Ring& ring, std::size_t i) {
  return ring[(i + ring.size() - 1) % ring.size()];
}

Vec2 after(const Ring& ring, std::size_t i) {
  return ring[(i + 1) % ring.size()];
}

/// Angle within a ring at a vertex, rad, whichever way round it goes.
double angle_within(const Ring& ring, std::size_t i) {
  const Vec2 to = after(ring, i) - ring[i], from = before(ring, i) - ring[i];
  const double turn = std::atan2(cross(to, from), dot(to, from)),
               angle = signed_area(ring) > 0 ? turn : -turn;
  return angle > 0 ? angle : angle + 2 * std::numbers::pi;
}

/// A ring of a block that has the point.
struct Place {
  std::size_t block, loop;
};

/// What lies on the far side of one loop of a block at a point that it shares with another: the block's
/// surroundings or what it encloses.
struct Sector {
  std::size_t loop;
  double angle;  ///< rad
  std::vector<Place> others;
};

/// The straight line that cuts a corner off from its point.
class CornerCut {
 public:
  CornerCut(const Ring& ring, std::size_t vertex, double length)
      : point_(ring[vertex]),
        start_(towards(before(ring, vertex), length)),
        end_(towards(after(ring, vertex), length)) {}

  Chord chord() const { return {point_, start_, end_}; }

  void apply(Ring& ring) const {
    const std::size_t vertex = *vertex_at(ring, point_);
    const Vec2 from = crossing(before(ring, vertex)), to = crossing(after(ring, vertex));
    ring[vertex] = from;
    ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(vertex) + 1, to);
  }

 private:
  Vec2 towards(Vec2 neighbour, double length) const {
    const Vec2 way = neighbour - point_;
    const double part = length / size_of(way);
    return point_ + part * way;
  }
  /// With the way from the point to a neighbour of it.
  Vec2 crossing(Vec2 neighbour) const {
    const Vec2 way = neighbour - point_, line = end_ - start_;
    const double along = cross(start_ - point_, line) / cross(way, line);
    return point_ + along * way;
  }

  Vec2 point_, start_, end_;
};

class Bridges {
 public:
  Bridges(std::vector<Block>& blocks, const Geos& geos) : blocks_(blocks), geos_(geos) {}

  const std::vector<Chord>& chords() const { return chords_; }

  void bridge(std::size_t block, Vec2 point) {
    std::vector<Sector> sectors = sectors_at(block, point);
    // An opening and what lies outside have no corner to give away, and of rock the bluntest stays.
    const auto stays = std::max_element(sectors.begin(), sectors.end(), [](const Sector& p, const Sector& q) {
      return std::pair(p.others.empty(), p.angle) < std::pair(q.others.empty(), q.angle);
    });
    for (auto sector = sectors.begin(); sector != sectors.end(); ++sector) {
      if (sector == stays) continue;
      if (sector->others.empty() || sector->angle > flattest) {
        throw std::runtime_error(fmt::format(
            "a block meets itself at {}, where nothing can be cut off between its two sides: move what ends "
            "there by a little",
            place_text(point, box_around(blocks_[block].loops[0]).size())));
      }
      cut(block, *sector, point);
    }
  }

 private:
  std::vector<Sector> sectors_at(std::size_t block, Vec2 point) const {
    std::vector<Sector> sectors;
    const std::vector<Place> others = others_at(block, point);
    for (std::size_t loop = 0; loop < blocks_[block].loops.size(); ++loop) {
      const Ring& ring = blocks_[block].loops[loop];
      const std::optional<std::size_t> vertex = vertex_at(ring, point);
      if (!vertex) continue;
      const double within = angle_within(ring, *vertex);
      Sector sector{loop, loop == 0 ? 2 * std::numbers::pi - within : within, {}};
      std::copy_if(others.begin(), others.end(), std::back_inserter(sector.others), [&](const Place& other) {
        return contains({ring}, geos_.point_within(blocks_[other.block].loops), 0) == (loop != 0);
      });
      sectors.push_back(std::move(sector));
    }
    return sectors;
  }

  std::vector<Place> others_at(std::size_t block, Vec2 point) const {
    std::vector<Place> others;
    for (std::size_t other = 0; other < blocks_.size(); ++other) {
      for (std::size_t loop = 0; other != block && loop < blocks_[other].loops.size(); ++loop) {
        if (vertex_at(blocks_[other].loops[loop], point)) others.push_back({other, loop});
      }
    }
    return others;
  }

  void cut(std::size_t block, const Sector& sector, Vec2 point) {
    std::vector<Place> places = sector.others;
    places.push_back({block, sector.loop});
    double length = std::numeric_limits<double>::infinity();
    for (const Place& place : places) {
      const Ring& ring = ring_of(place);
      const std::size_t vertex = *vertex_at(ring, point);
      length = std::min({length, share * size_of(before(ring, vertex) - point),
                         share * size_of(after(ring, vertex) - point)});
    }
    // Of a block within a block the corner was cut off before.
    for (const Place& other : sector.others) {
      for (const Ring& ring : blocks_[other.block].loops) {
        for (const Vec2 vertex : ring) {
          const double away = size_of(vertex - point);
          if (away > 0) length = std::min(length, away / 4);
        }
      }
    }
    const Ring& ring = ring_of({block, sector.loop});
    const CornerCut line(ring, *vertex_at(ring, point), length);
    for (const Place& place : places) line.apply(ring_of(place));
    chords_.push_back(line.chord());
  }

  Ring& ring_of(const Place& place) { return blocks_[place.block].loops[place.loop]; }

  std::vector<Block>& blocks_;
  const Geos& geos_;
  std::vector<Chord> chords_;
};

/// Vertices of a ring within a distance of a point become one there. Not where it comes by twice, or would
/// lose its area.
void gather(Ring& ring, Vec2 point, double near) {
  const auto is_near = [&](Vec2 vertex) { return size_of(vertex - point) <= near; };
  const auto far = std::ranges::find_if_not(ring, is_near);
  std::rotate(ring.begin(), far, ring.end());
  const auto first = std::ranges::find_if(ring, is_near), last = std::find_if_not(first, ring.end(), is_near);
  if (first == ring.end() || std::any_of(last, ring.end(), is_near)) return;
  if (ring.end() - last + (first - ring.begin()) < 2) return;
  *first = point;
  ring.erase(first + 1, last);
}

/// Points that more than one loop of a block has.
std::vector<Vec2> pinches_of(const Block& block) {
  std::vector<Vec2> found;
  if (block.loops.size() == 1) return found;
  std::map<std::pair<double, double>, std::size_t> loops;
  for (const Ring& ring : block.loops) {
    for (const Vec2 vertex : ring) {
      if (++loops[{vertex.x, vertex.y}] == 2) found.push_back(vertex);
    }
  }
  return found;
}

}  // namespace

Bridged bridge_pinches(std::vector<Block>& blocks, double near, const Geos& geos) {
  std::vector<Vec2> met;
  for (const Block& block : blocks) std::ranges::copy(pinches_of(block), std::back_inserter(met));
  for (const Vec2 point : met) {
    for (Block& block : blocks) {
      for (Ring& ring : block.loops) gather(ring, point, near);
    }
  }
  std::vector<double> outline;
  for (const Block& block : blocks) outline.push_back(std::abs(signed_area(block.loops[0])));
  std::vector<std::size_t> order(blocks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // What lies within another comes first.
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t p, std::size_t q) { return outline[p] < outline[q]; });
  Bridges bridges(blocks, geos);
  std::vector<Vec2> points;
  std::set<std::pair<double, double>> told;
  for (const std::size_t block : order) {
    for (const Vec2 point : pinches_of(blocks[block])) {
      bridges.bridge(block, point);
      if (told.emplace(point.x, point.y).second) points.push_back(point);
    }
  }
  return {points, bridges.chords()};
}

}  // namespace talus
