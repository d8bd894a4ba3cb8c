#pragma once

#include <talus/overlap/cells.hpp>

#include <span>

namespace talus::overlap {

/// The overlap of one piece of body a with one piece of body b.
struct Overlap {
  Piece piece[2];
  Polygon polygon;
  std::uint32_t group = 0;
};

/// Where a group of overlaps lies, to find it again one step later.
struct GroupSpan {
  Point centre;
  double size;    ///< m, a measure of its length
  double reach;   ///< m, half its extent and what it can have moved in a step
  Point along;    ///< unit vector, where it is longest
  double across;  ///< m, the most that it lies off the line along `along` through `centre`, and that motion
};

/// Finds the overlaps of a pair and which of them are one contact: a concave body is cut into convex pieces,
/// and overlaps that touch along such a cut belong together.
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
      if (polygon.empty() || !(area_centroid(polygon).area > 0)) continue;
      overlap.polygon.assign(polygon);
      ++count_;
    }
    return count_;
  }

  /// Numbers the groups from 0 in the order of their first members; returns how many there are.
  std::uint32_t group() {
    std::uint32_t groups = 0;
    for (std::uint32_t i = 0; i < count_; ++i) pool_[i].group = count_;
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (pool_[i].group != count_) continue;
      pool_[i].group = groups;
      spread(groups);
      ++groups;
    }
    return groups;
  }

  std::span<const Overlap> overlaps() const { return {pool_.data(), count_}; }

  GroupSpan span(std::uint32_t group, double dt) const {
    Point low{1e300, 1e300}, high{-1e300, -1e300};
    double speed = 0;
    for (const Overlap& overlap : overlaps()) {
      if (overlap.group != group) continue;
      for (const Corner& corner : overlap.polygon) {
        low = {std::min(low.x, corner.at.x), std::min(low.y, corner.at.y)};
        high = {std::max(high.x, corner.at.x), std::max(high.y, corner.at.y)};
      }
      for (const Piece& piece : overlap.piece) {
        for (std::uint32_t i = 0; i < piece.size(); ++i) speed = std::max(speed, length(piece.velocity(i)));
      }
    }
    const double size = length(high - low), moved = 2 * speed * dt;
    const Point centre = 0.5 * (low + high), end = farthest(group, centre), other = farthest(group, end);
    const double extent = length(other - end);
    const Point along = extent > 0 ? (1 / extent) * (other - end) : Point{1, 0};
    double across = 0;
    for (const Overlap& overlap : overlaps()) {
      if (overlap.group != group) continue;
      for (const Corner& corner : overlap.polygon)
        across = std::max(across, std::abs(cross(along, corner.at - centre)));
    }
    return {centre, size, size / 2 + moved, along, across + moved};
  }

 private:
  /// The corner of a group that lies farthest from a point.
  Point farthest(std::uint32_t group, Point from) const {
    Point found = from;
    double largest = 0;
    for (const Overlap& overlap : overlaps()) {
      if (overlap.group != group) continue;
      for (const Corner& corner : overlap.polygon) {
        const double distance = length(corner.at - from);
        if (distance > largest) largest = distance, found = corner.at;
      }
    }
    return found;
  }

  void spread(std::uint32_t group) {
    for (bool grown = true; grown;) {
      grown = false;
      for (std::uint32_t i = 0; i < count_; ++i) {
        if (pool_[i].group != count_) continue;
        for (std::uint32_t j = 0; j < count_ && pool_[i].group == count_; ++j) {
          if (pool_[j].group == group && joined(pool_[i], pool_[j])) {
            pool_[i].group = group;
            grown = true;
          }
        }
      }
    }
  }

  /// Whether two overlaps share a stretch of one cut.
  static bool joined(const Overlap& p, const Overlap& q) {
    for (std::size_t i = 0; i < p.polygon.size(); ++i) {
      const SideLabel side = p.polygon[i].side;
      if (!is_cut(p, side)) continue;
      for (std::size_t j = 0; j < q.polygon.size(); ++j) {
        const SideLabel other = q.polygon[j].side;
        if (!is_cut(q, other) || other.body != side.body) continue;
        if (p.piece[side.body].cut(side.index) != q.piece[side.body].cut(other.index)) continue;
        if (stretches_meet(p, i, q, j)) return true;
      }
    }
    return false;
  }

  static bool is_cut(const Overlap& overlap, SideLabel side) {
    return side.body < 2 && overlap.piece[side.body].is_cut(side.index);
  }

  static bool stretches_meet(const Overlap& p, std::size_t i, const Overlap& q, std::size_t j) {
    const SideLabel side = p.polygon[i].side;
    const Point along = p.piece[side.body].tangent(side.index);
    const auto interval = [&](const Polygon& polygon, std::size_t k) {
      const double first = dot(along, polygon[k].at),
                   second = dot(along, polygon[k + 1 == polygon.size() ? 0 : k + 1].at);
      return std::pair{std::min(first, second), std::max(first, second)};
    };
    const auto [low, high] = interval(p.polygon, i);
    const auto [other_low, other_high] = interval(q.polygon, j);
    return low <= other_high && other_low <= high;
  }

  OverlapFinder finder_;
  std::vector<Overlap> pool_;
  std::uint32_t count_ = 0;
};

}  // namespace talus::overlap
