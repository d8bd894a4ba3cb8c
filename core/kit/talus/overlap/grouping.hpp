#pragma once

#include <talus/overlap/cells.hpp>

#include <span>

namespace talus::overlap {

/// The overlap of one piece of body a with one piece of body b.
struct Overlap {
  Piece piece[2];
  Polygon polygon;
  AreaCentroid region;
  std::uint32_t cluster = 0;  ///< of overlaps that meet along cuts
  std::uint32_t group = 0;    ///< of those of a cluster that are one contact
};

/// Where a group of overlaps lies, to find it again one step later.
struct GroupSpan {
  Point centre;   ///< where that was a step ago if it moved with the bodies
  double size;    ///< m, a measure of its length
  double reach;   ///< m, half its extent and what it can have moved otherwise in a step
  Point along;    ///< unit vector, where it is longest
  double across;  ///< m, the most that it lies off the line along `along` through `centre`, and that motion
};

/// Finds the overlaps of a pair and which of them are one contact: a concave body is cut into convex pieces,
/// and overlaps that touch along such a cut belong together, in a cluster: the pressure goes on behind it. Of
/// these a group is one contact. Where the cut begins in a reflex corner that the other body fills, its two
/// faces are two, as those of two bodies would be: what presses them apart is nothing to the resultant, by
/// which friction would go.
class OverlapGroups {
 public:
  std::uint32_t find(const ContactBatch& batch, const BodyPair& pair) {
    count_ = 0;
    for (const PiecePair pieces : batch.piece_pairs.of(pair)) {
      if (count_ == pool_.size()) pool_.emplace_back();
      Overlap& overlap = pool_[count_];
      overlap.piece[0] = Piece(batch.boundaries, pieces.a, {0, 0}, pieces.load_start);
      overlap.piece[1] = Piece(batch.boundaries, pieces.b, {pair.offset_x, pair.offset_y},
                               pieces.load_start + overlap.piece[0].size());
      const Polygon& polygon = finder_.find(overlap.piece[0], overlap.piece[1]);
      if (polygon.empty()) continue;
      overlap.region = area_centroid(polygon);
      if (!(overlap.region.area > 0)) continue;
      overlap.polygon.assign(polygon);
      ++count_;
    }
    return count_;
  }

  /// Numbers the clusters from 0 in the order of their first members, and the groups cluster by cluster in
  /// the same order; returns how many groups there are.
  std::uint32_t group() {
    for (std::uint32_t i = 0; i < count_; ++i) pool_[i].cluster = pool_[i].group = i;
    list_stretches();
    for (std::size_t i = 1; i < stretches_.size(); ++i) {
      for (std::size_t j = i; j-- > 0 && stretches_[j].cut == stretches_[i].cut;) {
        const Stretch &p = stretches_[i], &q = stretches_[j];
        if (pool_[p.overlap].group == pool_[q.overlap].group || !meet(p, q)) continue;
        join(p.overlap, q.overlap, &Overlap::cluster);
        if (!in_reflex_corner(p, q)) join(p.overlap, q.overlap, &Overlap::group);
      }
    }
    return number();
  }

  std::span<const Overlap> overlaps() const { return {pool_.data(), count_}; }

  std::uint32_t clusters() const { return static_cast<std::uint32_t>(first_group_.size() - 1); }
  /// The groups of a cluster are those from first_group(cluster) on, before that of the next cluster.
  std::uint32_t first_group(std::uint32_t cluster) const { return first_group_[cluster]; }

  /// Members of a group, as places in overlaps(), rising.
  std::span<const std::uint32_t> members(std::uint32_t group) const { return in_group_.of(group); }
  std::span<const std::uint32_t> cluster_members(std::uint32_t cluster) const {
    return in_cluster_.of(cluster);
  }

  Point centre(std::uint32_t group) const {
    const Box box = box_of(group);
    return 0.5 * (box.low + box.high);
  }

  GroupSpan span(std::uint32_t group, double dt) const {
    const auto each_velocity = [&](const auto& visit) {
      for (const std::uint32_t i : members(group)) {
        for (const Piece& piece : pool_[i].piece) {
          for (std::uint32_t k = 0; k < piece.size(); ++k) visit(piece.velocity(k));
        }
      }
    };
    Point drift{0, 0};
    double corners = 0, speed = 0;
    each_velocity([&](Point velocity) { drift = drift + velocity, corners += 1; });
    drift = (1 / corners) * drift;
    each_velocity([&](Point velocity) { speed = std::max(speed, length(velocity - drift)); });
    const auto [low, high] = box_of(group);
    const double size = length(high - low), moved = 2 * speed * dt;
    const Point centre = 0.5 * (low + high), end = farthest(group, centre), other = farthest(group, end);
    const double extent = length(other - end);
    const Point along = extent > 0 ? (1 / extent) * (other - end) : Point{1, 0};
    double across = 0;
    for (const std::uint32_t i : members(group)) {
      for (const Corner& corner : pool_[i].polygon)
        across = std::max(across, std::abs(cross(along, corner.at - centre)));
    }
    return {centre - dt * drift, size, size / 2 + moved, along, across + moved};
  }

 private:
  struct Box {
    Point low, high;
  };
  Box box_of(std::uint32_t group) const {
    Box box{{1e300, 1e300}, {-1e300, -1e300}};
    for (const std::uint32_t i : members(group)) {
      for (const Corner& corner : pool_[i].polygon) {
        box.low = {std::min(box.low.x, corner.at.x), std::min(box.low.y, corner.at.y)};
        box.high = {std::max(box.high.x, corner.at.x), std::max(box.high.y, corner.at.y)};
      }
    }
    return box;
  }

  /// The corner of a group that lies farthest from a point.
  Point farthest(std::uint32_t group, Point from) const {
    Point found = from;
    double largest = 0;
    for (const std::uint32_t i : members(group)) {
      for (const Corner& corner : pool_[i].polygon) {
        const double distance = length(corner.at - from);
        if (distance > largest) largest = distance, found = corner.at;
      }
    }
    return found;
  }

  /// Where an overlap is bounded by a cut.
  struct Stretch {
    std::uint64_t cut;  ///< its number, and the body's in the upper half
    std::uint32_t overlap;
    std::uint32_t side;  ///< of the polygon
  };

  void list_stretches() {
    stretches_.clear();
    for (std::uint32_t i = 0; i < count_ && count_ > 1; ++i) {
      const Overlap& overlap = pool_[i];
      for (std::uint32_t side = 0; side < overlap.polygon.size(); ++side) {
        const SideLabel label = overlap.polygon[side].side;
        // Overlaps with one strip meet at its cuts in points, which rounding would have them share or not.
        if (label.body > 1 || overlap.piece[label.body].is_strip()) continue;
        if (!overlap.piece[label.body].is_cut(label.index)) continue;
        stretches_.push_back(
            {std::uint64_t{label.body} << 32 | overlap.piece[label.body].cut(label.index), i, side});
      }
    }
    std::sort(stretches_.begin(), stretches_.end(), [](const Stretch& p, const Stretch& q) {
      return std::pair{p.cut, p.overlap} < std::pair{q.cut, q.overlap};
    });
  }

  bool meet(const Stretch& p, const Stretch& q) const {
    const SideLabel side = pool_[p.overlap].polygon[p.side].side;
    // So do overlaps of two strips along the cut of a piece that both meet.
    const Piece &facing = pool_[p.overlap].piece[1 - side.body],
                &other = pool_[q.overlap].piece[1 - side.body];
    if (facing.is_strip() && facing.first_corner() != other.first_corner()) return false;
    const Point along = pool_[p.overlap].piece[side.body].tangent(side.index);
    const auto interval = [&](const Stretch& stretch) {
      const Polygon& polygon = pool_[stretch.overlap].polygon;
      const double first = dot(along, polygon[stretch.side].at),
                   second = dot(along, polygon[polygon.next(stretch.side)].at);
      return std::pair{std::min(first, second), std::max(first, second)};
    };
    const auto [low, high] = interval(p);
    const auto [other_low, other_high] = interval(q);
    return low <= other_high && other_low <= high;
  }

  /// Whether the overlaps reach to the boundary on both sides of an end of the cut, and that is bent inwards
  /// there.
  bool in_reflex_corner(const Stretch& p, const Stretch& q) const {
    return bent_inwards(beside(q, false), beside(p, true)) || bent_inwards(beside(p, false), beside(q, true));
  }

  /// The tangent of the boundary that goes on from the end of a stretch, or leads to its start; none where
  /// the other body or another cut bounds the overlap there.
  Point beside(const Stretch& stretch, bool after) const {
    const Overlap& overlap = pool_[stretch.overlap];
    const Polygon& polygon = overlap.polygon;
    const std::size_t before = (stretch.side == 0 ? polygon.size() : stretch.side) - 1;
    const SideLabel own = polygon[stretch.side].side,
                    label = polygon[after ? polygon.next(stretch.side) : before].side;
    if (label.body != own.body || !overlap.piece[label.body].real(label.index)) return {0, 0};
    return overlap.piece[label.body].tangent(label.index);
  }

  /// From the side that leads to a corner to the one that goes on there, counter-clockwise around the body.
  static bool bent_inwards(Point leads, Point goes_on) {
    constexpr double least = 1e-3;  // a bend that is less is that of a straight side
    return cross(leads, goes_on) < (dot(leads, goes_on) > 0 ? -least : 0.0);
  }

  void join(std::uint32_t p, std::uint32_t q, std::uint32_t Overlap::*number) {
    const std::uint32_t low = std::min(pool_[p].*number, pool_[q].*number),
                        high = std::max(pool_[p].*number, pool_[q].*number);
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (pool_[i].*number == high) pool_[i].*number = low;
    }
  }

  /// Overlaps by cluster or by group, rising in each.
  struct Members {
    std::vector<std::uint32_t> member, start;

    void list(std::span<const Overlap> overlaps, std::uint32_t Overlap::*number, std::uint32_t count) {
      start.assign(count + 1, 0);
      for (const Overlap& overlap : overlaps) ++start[overlap.*number];
      for (std::uint32_t k = 0, end = 0; k < count; ++k) start[k] = end += start[k];
      const auto all = static_cast<std::uint32_t>(overlaps.size());
      start[count] = all;
      member.resize(all);
      for (std::uint32_t i = all; i-- > 0;) member[--start[overlaps[i].*number]] = i;
    }
    std::span<const std::uint32_t> of(std::uint32_t k) const {
      return std::span(member).subspan(start[k], start[k + 1] - start[k]);
    }
  };

  /// Until here clusters and groups have the number of their first member.
  std::uint32_t number() {
    std::uint32_t clusters = 0, groups = 0;
    for (std::uint32_t i = 0; i < count_; ++i)
      pool_[i].cluster = pool_[i].cluster == i ? clusters++ : pool_[pool_[i].cluster].cluster;
    in_cluster_.list(overlaps(), &Overlap::cluster, clusters);
    first_group_.clear();
    for (std::uint32_t c = 0; c < clusters; ++c) {
      first_group_.push_back(groups);
      for (const std::uint32_t i : in_cluster_.of(c))
        pool_[i].group = pool_[i].group == i ? groups++ : pool_[pool_[i].group].group;
    }
    first_group_.push_back(groups);
    in_group_.list(overlaps(), &Overlap::group, groups);
    return groups;
  }

  OverlapFinder finder_;
  std::vector<Overlap> pool_;
  std::uint32_t count_ = 0;
  std::vector<Stretch> stretches_;
  Members in_cluster_, in_group_;
  std::vector<std::uint32_t> first_group_;  ///< [cluster], and the number of groups
};

}  // namespace talus::overlap
