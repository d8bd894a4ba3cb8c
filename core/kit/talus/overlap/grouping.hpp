#pragma once

#include <talus/overlap/cells.hpp>

#include <span>

namespace talus::overlap {

/// The overlap of one piece of body a with one piece of body b.
struct Overlap {
  Piece piece[2];
  Polygon polygon;
  AreaCentroid region;
  std::uint32_t group = 0;
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
      if (polygon.empty()) continue;
      overlap.region = area_centroid(polygon);
      if (!(overlap.region.area > 0)) continue;
      overlap.polygon.assign(polygon);
      ++count_;
    }
    return count_;
  }

  /// Numbers the groups from 0 in the order of their first members; returns how many there are.
  std::uint32_t group() {
    for (std::uint32_t i = 0; i < count_; ++i) pool_[i].group = i;
    list_stretches();
    for (std::size_t i = 1; i < stretches_.size(); ++i) {
      for (std::size_t j = i; j-- > 0 && stretches_[j].cut == stretches_[i].cut;) {
        if (joined(stretches_[i], stretches_[j])) join(stretches_[i].overlap, stretches_[j].overlap);
      }
    }
    return number_groups();
  }

  std::span<const Overlap> overlaps() const { return {pool_.data(), count_}; }

  /// Members of a group, as places in overlaps(), rising.
  std::span<const std::uint32_t> members(std::uint32_t group) const {
    return std::span(member_).subspan(member_start_[group], member_start_[group + 1] - member_start_[group]);
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

  bool joined(const Stretch& p, const Stretch& q) const {
    if (pool_[p.overlap].group == pool_[q.overlap].group) return false;
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

  void join(std::uint32_t p, std::uint32_t q) {
    const std::uint32_t low = std::min(pool_[p].group, pool_[q].group),
                        high = std::max(pool_[p].group, pool_[q].group);
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (pool_[i].group == high) pool_[i].group = low;
    }
  }

  /// Until here a group has the number of its first member.
  std::uint32_t number_groups() {
    std::uint32_t groups = 0;
    for (std::uint32_t i = 0; i < count_; ++i)
      pool_[i].group = pool_[i].group == i ? groups++ : pool_[pool_[i].group].group;
    member_start_.assign(groups + 1, 0);
    for (const Overlap& overlap : overlaps()) ++member_start_[overlap.group];
    for (std::uint32_t g = 0, end = 0; g < groups; ++g) member_start_[g] = end += member_start_[g];
    member_start_[groups] = count_;
    member_.resize(count_);
    for (std::uint32_t i = count_; i-- > 0;) member_[--member_start_[pool_[i].group]] = i;
    return groups;
  }

  OverlapFinder finder_;
  std::vector<Overlap> pool_;
  std::uint32_t count_ = 0;
  std::vector<Stretch> stretches_;
  std::vector<std::uint32_t> member_, member_start_;
};

}  // namespace talus::overlap
