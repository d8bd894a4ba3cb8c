#pragma once

#include <talus/overlap/piece.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus::overlap {

/// The overlap of two convex pieces: sides labelled with the body they come from. Empty when they are apart.
/// Corners within a straight side of either piece are corners of it, so that it is the same whichever is a.
class OverlapFinder {
 public:
  const Polygon& find(const Piece& a, const Piece& b) {
    polygon_.clear();
    if (separated(a, b)) return polygon_;
    polygon_.make_room(b.size());
    for (std::uint32_t j = 0; j < b.size(); ++j) polygon_.append({b.at(j), {1, j}});
    bool straight_on = false;
    for (std::uint32_t k = 0; k < a.size() && !polygon_.empty(); ++k) {
      if (!(a.length(k) > 0)) continue;
      // A second cut along one line would be where rounding has it.
      if (goes_straight_on(a, k))
        straight_on = true;
      else
        clipper_.clip(polygon_, {0, k}, [&](Point p) { return -a.depth(k, p); });
    }
    if (straight_on && !polygon_.empty()) divide_straight_sides(a);
    return polygon_;
  }

 private:
  /// Whether a side lies on the line of the one before. A turn of more is one that corners can be found at.
  static bool goes_straight_on(const Piece& a, std::uint32_t k) {
    constexpr double least = 1e-10;
    if (a.is_strip() || !(a.length(k) > 0)) return false;
    std::uint32_t before = a.previous(k);
    while (!(a.length(before) > 0)) before = a.previous(before);
    return std::abs(cross(a.tangent(before), a.tangent(k))) <= least &&
           dot(a.tangent(before), a.tangent(k)) > 0;
  }

  /// Of sides on one line the first has cut: each gets its own part of the edge.
  void divide_straight_sides(const Piece& a) {
    whole_.swap(polygon_);
    polygon_.clear();
    polygon_.make_room(whole_.size() + a.size());
    for (std::size_t i = 0; i < whole_.size(); ++i) {
      Corner corner = whole_[i];
      if (corner.side.body != 0) {
        polygon_.append(corner);
        continue;
      }
      const Point start = corner.at, end = whole_[whole_.next(i)].at;
      std::uint32_t& side = corner.side.index;
      for (std::uint32_t next = a.next(side); next != whole_[i].side.index; next = a.next(next)) {
        if (!(a.length(next) > 0)) continue;
        if (!goes_straight_on(a, next)) break;
        const Point at = a.at(next), along = a.tangent(next);
        if (!(dot(along, end - at) > 0)) break;
        if (dot(along, at - start) > 0) {
          polygon_.append(corner);
          corner.at = at;
        }
        side = next;
      }
      polygon_.append(corner);
    }
  }

  /// Whether the line of some side has the whole other piece outside.
  static bool separated(const Piece& a, const Piece& b) { return one_way(a, b) || one_way(b, a); }

  static bool one_way(const Piece& piece, const Piece& other) {
    for (std::uint32_t k = 0; k < piece.size(); ++k) {
      if (piece.length(k) > 0 && all_outside(piece, k, other)) return true;
    }
    return false;
  }

  static bool all_outside(const Piece& piece, std::uint32_t side, const Piece& other) {
    for (std::uint32_t i = 0; i < other.size(); ++i) {
      if (piece.depth(side, other.at(i)) > 0) return false;
    }
    return true;
  }

  Polygon polygon_, whole_;
  Clipper clipper_;
};

/// Divides an overlap into the cells nearest to each side of the master (§3.2.1, Fig. 4). Between sides that
/// share a vertex the division line is the inner bisector (the perpendicular where they are collinear); any
/// other two sides compete by distance too, or a thin master would count its overlap twice.
class CellDivider {
 public:
  /// Calls visit(side, cell) for each side of the master, `body` of the pair, that owns a part of the
  /// overlap.
  template <class Visit>
  void divide(const Piece& master, std::uint32_t body, const Polygon& overlap, const Visit& visit) {
    if (master.is_strip()) {  // all of it lies behind side 0
      if (master.real(0)) visit(0u, overlap);
      return;
    }
    find_competitors(master, overlap);
    for (const std::uint32_t k : competitors_) {
      cell_.assign(overlap);
      for (const std::uint32_t j : competitors_) {
        if (j == k || cell_.empty()) continue;
        cut_towards(master, body, k, j);
      }
      if (!cell_.empty()) visit(k, cell_);
    }
  }

 private:
  /// A side can own a point only if it comes nearer to the overlap than the deepest point is to any side.
  void find_competitors(const Piece& master, const Polygon& overlap) {
    competitors_.clear();
    nearest_.clear();
    double reach = std::numeric_limits<double>::infinity();
    for (std::uint32_t k = 0; k < master.size(); ++k) {
      if (!master.real(k)) continue;
      double least = std::numeric_limits<double>::infinity(), most = -least;
      for (const Corner& corner : overlap) {
        const double depth = master.depth(k, corner.at);
        least = std::min(least, depth);
        most = std::max(most, depth);
      }
      reach = std::min(reach, most);
      competitors_.push_back(k);
      nearest_.push_back(least);
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < competitors_.size(); ++i) {
      if (nearest_[i] <= reach) competitors_[kept++] = competitors_[i];
    }
    competitors_.resize(kept);
  }

  void cut_towards(const Piece& master, std::uint32_t body, std::uint32_t k, std::uint32_t j) {
    const SideLabel label{between_sides + body, j};
    const bool before = master.next(k) == j, after = master.next(j) == k;
    if (before || after) {
      const Point vertex = master.at(before ? j : k);
      const Point along = (before ? 1.0 : -1.0) * (master.tangent(k) + master.tangent(j));
      clipper_.clip(cell_, label, [&](Point p) { return dot(along, p - vertex); });
      return;
    }
    const Point apart = master.tangent(k) - master.tangent(j);
    if (dot(apart, apart) < 1e-24) return;  // one line: the sides between them divide it
    clipper_.clip(cell_, label, [&](Point p) { return master.depth(k, p) - master.depth(j, p); });
  }

  std::vector<std::uint32_t> competitors_;
  std::vector<double> nearest_;
  Polygon cell_;
  Clipper clipper_;
};

}  // namespace talus::overlap
