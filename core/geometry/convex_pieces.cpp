#include "geometry/convex_pieces.hpp"

#include <talus/contact_model.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace talus {
namespace {

/// A connected region: one ring is its outer boundary, the others are holes.
using RingSet = std::vector<ConvexPiece>;

Vec2 direction(Vec2 from, Vec2 to) {
  const double dx = to.x - from.x, dy = to.y - from.y, size = std::sqrt(dx * dx + dy * dy);
  return {dx / size, dy / size};
}

std::size_t next(const ConvexPiece& ring, std::size_t i) {
  return i + 1 == ring.size() ? 0 : i + 1;
}
std::size_t previous(const ConvexPiece& ring, std::size_t i) {
  return i == 0 ? ring.size() - 1 : i - 1;
}

struct Place {
  std::size_t ring, corner;
};

bool is_reflex(const ConvexPiece& ring, std::size_t i) {
  const Vec2 in = direction(ring[previous(ring, i)].at, ring[i].at);
  const Vec2 out = direction(ring[i].at, ring[next(ring, i)].at);
  const bool spike = in.x * out.x + in.y * out.y < -1 + 1e-12;
  return cross(in, out) < -1e-12 || (spike && cross(in, out) <= 0);
}

std::optional<Place> reflex_corner(const RingSet& region) {
  for (std::size_t r = 0; r < region.size(); ++r) {
    for (std::size_t i = 0; i < region[r].size(); ++i) {
      if (is_reflex(region[r], i)) return Place{r, i};
    }
  }
  return std::nullopt;
}

Vec2 inner_bisector(const ConvexPiece& ring, std::size_t i) {
  const Vec2 in = direction(ring[previous(ring, i)].at, ring[i].at);
  const Vec2 out = direction(ring[i].at, ring[next(ring, i)].at);
  const Vec2 sum{-in.y - out.y, in.x + out.x};
  const double size = std::sqrt(sum.x * sum.x + sum.y * sum.y);
  return size > 1e-9 ? sum / size : in;
}

struct Hit {
  Place side;
  double distance, share;  ///< m, from the corner; where on the side, from its start
};

/// First boundary ahead of a corner.
Hit first_ahead(const RingSet& region, Place from, Vec2 along) {
  const Vec2 start = region[from.ring][from.corner].at;
  Hit nearest{{}, std::numeric_limits<double>::infinity(), 0};
  for (std::size_t r = 0; r < region.size(); ++r) {
    const ConvexPiece& ring = region[r];
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::size_t end = next(ring, i);
      if (r == from.ring && (i == from.corner || end == from.corner)) continue;
      const Vec2 side = ring[end].at - ring[i].at;
      // One along the way is met at its end, which is that of another.
      const double facing = cross(side, along);
      if (!(facing < -1e-9 * size_of(side))) continue;
      const Vec2 away = ring[i].at - start;
      const double distance = cross(away, side) / cross(along, side);
      const double share = cross(away, along) / cross(along, side);
      if (share < -1e-9 || share > 1 + 1e-9 || !(distance > 0) || distance >= nearest.distance) continue;
      nearest = {{r, i}, distance, share};
    }
  }
  if (!std::isfinite(nearest.distance)) throw Indivisible(start);
  return nearest;
}

/// Of the corners at one place, two where a cut to another ring ends, that between whose sides a cut arrives.
Place that_faces(const RingSet& region, Place corner, Vec2 along) {
  const auto angle = [](Vec2 from, Vec2 to) {
    const double turned = std::atan2(cross(from, to), from.x * to.x + from.y * to.y);
    return turned < 0 ? turned + 2 * std::numbers::pi : turned;
  };
  const ConvexPiece& ring = region[corner.ring];
  const Vec2 at = ring[corner.corner].at, back{-along.x, -along.y};
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (ring[i].at.x != at.x || ring[i].at.y != at.y) continue;
    const Vec2 out = direction(at, ring[next(ring, i)].at), in = direction(at, ring[previous(ring, i)].at);
    const double margin = std::min(angle(out, back), angle(out, in) - angle(out, back));
    if (margin > most) most = margin, corner.corner = i;
  }
  return corner;
}

/// Where a cut ends; splits the side it hits unless the hit is at one of its ends.
Place cut_target(RingSet& region, Place from, Vec2 along) {
  const auto [side, distance, share] = first_ahead(region, from, along);
  ConvexPiece& ring = region[side.ring];
  if (share < 1e-9) return that_faces(region, side, along);
  if (share > 1 - 1e-9) return that_faces(region, {side.ring, next(ring, side.corner)}, along);
  PieceCorner corner = ring[side.corner];
  const Vec2 end = ring[next(ring, side.corner)].at;
  corner.at += share * (end - corner.at);
  ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(side.corner) + 1, corner);
  return {side.ring, side.corner + 1};
}

/// Centroid of a body and the longer side of the box around it, m.
std::pair<Vec2, double> middle_and_extent(const RingSet& whole) {
  const Vec2 origin = whole[0][0].at;
  double area = 0, x = 0, y = 0;
  Vec2 low{0, 0}, high{0, 0};
  for (const ConvexPiece& ring : whole) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 p = ring[i].at - origin, q = ring[next(ring, i)].at - origin;
      area += cross(p, q) / 2;
      x += cross(p, q) * (p.x + q.x) / 6;
      y += cross(p, q) * (p.y + q.y) / 6;
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  return {{origin.x + x / area, origin.y + y / area}, std::max(high.x - low.x, high.y - low.y)};
}

struct ReflexCorner {
  Vec2 at;
  double keys[3];  ///< m: reach, distance from the centroid, how far its bisector passes it by
};

/// By one key after the other; what differs by no more than `rounding` is equal.
void sort_by_keys(std::span<ReflexCorner> corners, std::size_t key, double rounding) {
  if (key == std::size(corners[0].keys)) return;
  std::stable_sort(corners.begin(), corners.end(),
                   [&](const ReflexCorner& p, const ReflexCorner& q) { return p.keys[key] < q.keys[key]; });
  for (std::size_t begin = 0, end = 1; begin < corners.size(); begin = end++) {
    while (end < corners.size() && corners[end].keys[key] - corners[end - 1].keys[key] <= rounding) ++end;
    if (end - begin > 1) sort_by_keys(corners.subspan(begin, end - begin), key + 1, rounding);
  }
}

/// The reflex corners of a body, that with the shortest way to the other side first: so which cut ends at
/// which depends neither on the corner nor on the direction from which the body is listed. Equal ones, as
/// those of a comb, follow from the centroid outwards, and of two at one distance that whose bisector leaves
/// the centroid on its right. Corners that a rotation brings to each other are as listed.
std::vector<ReflexCorner> reflex_corners_by_reach(const RingSet& whole) {
  const auto [middle, extent] = middle_and_extent(whole);
  std::vector<ReflexCorner> found;
  for (std::size_t r = 0; r < whole.size(); ++r) {
    for (std::size_t i = 0; i < whole[r].size(); ++i) {
      if (!is_reflex(whole[r], i)) continue;
      const Vec2 at = whole[r][i].at, bisector = inner_bisector(whole[r], i), out = at - middle;
      found.push_back(
          {at, {first_ahead(whole, {r, i}, bisector).distance, size_of(out), cross(out, bisector)}});
    }
  }
  if (!found.empty()) sort_by_keys(found, 0, 1e-9 * extent);
  return found;
}

/// Corners from `first` round to `last`, then back along the cut.
ConvexPiece part(const ConvexPiece& ring, std::size_t first, std::size_t last, std::uint32_t cut) {
  ConvexPiece result;
  for (std::size_t i = first; i != last; i = next(ring, i)) result.push_back(ring[i]);
  result.push_back({ring[last].at, internal_side, cut});
  return result;
}

bool inside(const ConvexPiece& ring, Vec2 p) {
  bool odd = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i].at, b = ring[next(ring, i)].at;
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) odd = !odd;
  }
  return odd;
}

double area_of(const ConvexPiece& ring) {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    twice += cross(ring[i].at - ring[0].at, ring[i + 1].at - ring[0].at);
  return twice / 2;
}

double area_of(std::span<const ConvexPiece> rings) {
  double sum = 0;
  for (const ConvexPiece& ring : rings) sum += area_of(ring);
  return sum;
}

/// Cuts a region until no corner is reflex.
class Divider {
 public:
  std::vector<ConvexPiece> divide(RingSet whole) {
    // No cut makes a corner reflex, and each leaves one less; where rounding sees it otherwise there is no
    // end.
    for (const ConvexPiece& ring : whole) most_cuts_ += ring.size();
    const std::vector<ReflexCorner> corners = reflex_corners_by_reach(whole);
    // Not by recursion: a saw of many teeth would exhaust the stack.
    std::vector<RingSet> waiting{std::move(whole)};
    for (const ReflexCorner& corner : corners) cut_from(waiting, corner.at);
    std::vector<ConvexPiece> pieces;
    while (!waiting.empty()) {
      RingSet region = std::move(waiting.back());
      waiting.pop_back();
      std::optional<RingSet> other_half = cut_first_half_off(region);
      if (!other_half) {
        pieces.push_back(std::move(region[0]));
        continue;
      }
      waiting.push_back(std::move(*other_half));
      waiting.push_back(std::move(region));
    }
    return pieces;
  }

 private:
  /// Makes the cut from the reflex corner at a place, in the region that has it.
  void cut_from(std::vector<RingSet>& regions, Vec2 at) {
    for (RingSet& region : regions) {
      for (std::size_t r = 0; r < region.size(); ++r) {
        for (std::size_t i = 0; i < region[r].size(); ++i) {
          if (region[r][i].at.x != at.x || region[r][i].at.y != at.y || !is_reflex(region[r], i)) continue;
          if (std::optional<RingSet> other_half = cut(region, {r, i}))
            regions.push_back(std::move(*other_half));
          return;
        }
      }
    }
  }

  /// What rounding has left reflex: makes cuts until one divides the region; keeps one half of it and returns
  /// the other. Nothing where all corners are convex.
  std::optional<RingSet> cut_first_half_off(RingSet& region) {
    while (const std::optional<Place> corner = reflex_corner(region)) {
      if (std::optional<RingSet> other_half = cut(region, *corner)) return other_half;
    }
    return std::nullopt;
  }

  /// Cuts from a reflex corner to the boundary ahead. If that divides the region, keeps one half of it and
  /// returns the other.
  std::optional<RingSet> cut(RingSet& region, Place from) {
    if (cuts_ == most_cuts_) throw Indivisible(region[from.ring][from.corner].at);
    const Vec2 along = inner_bisector(region[from.ring], from.corner);
    const std::size_t before = region[from.ring].size();
    const Place to = cut_target(region, from, along);
    if (to.ring == from.ring && region[from.ring].size() > before && to.corner <= from.corner) ++from.corner;
    if (to.ring == from.ring) return halve(region, from, to);
    join(region, from, to);
    return std::nullopt;
  }

  /// A cut to another ring makes one of the two.
  void join(RingSet& region, Place from, Place to) {
    const auto cut = static_cast<std::uint32_t>(cuts_++);
    ConvexPiece joined = part(region[from.ring], next(region[from.ring], from.corner), from.corner, cut);
    const ConvexPiece other = part(region[to.ring], next(region[to.ring], to.corner), to.corner, cut);
    joined.insert(joined.begin(), region[from.ring][from.corner]);
    joined.push_back(region[to.ring][to.corner]);
    joined.insert(joined.end(), other.begin(), other.end());
    const auto [low, high] = std::minmax(from.ring, to.ring);
    region[low] = joined;
    region.erase(region.begin() + static_cast<std::ptrdiff_t>(high));
  }

  RingSet halve(RingSet& region, Place from, Place to) {
    const auto cut = static_cast<std::uint32_t>(cuts_++);
    const ConvexPiece ring = region[from.ring];
    RingSet halves[2] = {{part(ring, from.corner, to.corner, cut)},
                         {part(ring, to.corner, from.corner, cut)}};
    // A hole is divided into a region of its own and what is still a hole.
    const std::size_t encloses = area_of(halves[0][0]) > 0 ? 0 : 1;
    for (std::size_t r = 0; r < region.size(); ++r) {
      if (r == from.ring) continue;
      halves[inside(halves[encloses][0], region[r][0].at) ? encloses : 1 - encloses].push_back(region[r]);
    }
    region = std::move(halves[0]);
    return std::move(halves[1]);
  }

  std::size_t cuts_ = 0, most_cuts_ = 0;
};

/// A corner that rounding made of a piece that is not convex, or whose side is so short that its direction is
/// rounding and runs past other corners: what lies behind such a side is lost to contact.
std::optional<Vec2> misled_corner(const ConvexPiece& piece) {
  double far = 0;
  Vec2 low = piece[0].at, high = low;
  for (const PieceCorner& corner : piece) {
    far = std::max({far, std::abs(corner.at.x), std::abs(corner.at.y)});
    low = {std::min(low.x, corner.at.x), std::min(low.y, corner.at.y)};
    high = {std::max(high.x, corner.at.x), std::max(high.y, corner.at.y)};
  }
  const double extent = std::max(high.x - low.x, high.y - low.y);
  const double allowed = 1e-8 * extent + 2e-13 * far;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Vec2 from = piece[i].at, to = piece[next(piece, i)].at;
    if (cross(from - piece[0].at, to - piece[0].at) < -0.1 * allowed * extent) return from;
    if (size_of(to - from) > 1e-6 * far) continue;
    // Of a ring that is convex else, corners are the further inside the further on, up to the opposite one.
    const Vec2 along = direction(from, to);
    const auto inside_by = [&](std::size_t k) { return cross(along, piece[k].at - from); };
    std::size_t ahead = next(piece, i), behind = i;
    do ahead = next(piece, ahead);
    while (ahead != i && std::abs(inside_by(ahead)) <= allowed);
    do behind = previous(piece, behind);
    while (behind != i && std::abs(inside_by(behind)) <= allowed);
    if (inside_by(ahead) < -allowed || inside_by(behind) < -allowed) return from;
  }
  return std::nullopt;
}

ConvexPiece ring_of(const Loop& loop) {
  ConvexPiece ring;
  for (std::size_t i = 0; i < loop.vertices.size(); ++i)
    ring.push_back({loop.vertices[i], loop.surface_class[i], 0});
  return ring;
}

}  // namespace

Indivisible::Indivisible(Vec2 at)
    : std::runtime_error(
          fmt::format("it cannot be cut into convex pieces near ({}, {}): corners are too sharp "
                      "or too near to other sides for the precision of numbers",
                      at.x, at.y)) {}

std::vector<ConvexPiece> convex_pieces(const Loop& outer, std::span<const Loop> holes) {
  RingSet region{ring_of(outer)};
  for (const Loop& hole : holes) region.push_back(ring_of(hole));
  const double area = area_of(region);
  std::vector<ConvexPiece> pieces = Divider().divide(std::move(region));
  // Where features are as small as rounding, cuts may leave a part out or take it twice.
  if (!(std::abs(area_of(pieces) - area) <= 1e-9 * area)) throw Indivisible(outer.vertices[0]);
  for (const ConvexPiece& piece : pieces) {
    if (const std::optional<Vec2> at = misled_corner(piece)) throw Indivisible(*at);
  }
  return pieces;
}

}  // namespace talus
