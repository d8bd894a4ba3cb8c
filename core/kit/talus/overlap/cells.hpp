#pragma once

#include <talus/overlap/piece.hpp>

#include <algorithm>
#include <limits>

namespace talus::overlap {

/// The overlap of two convex pieces: sides labelled with the body they come from. Empty when they are apart.
class OverlapFinder {
 public:
  const Polygon& find(const Piece& a, const Piece& b) {
    polygon_.clear();
    if (separated(a, b)) return polygon_;
    polygon_.make_room(b.size());
    for (std::uint32_t j = 0; j < b.size(); ++j) polygon_.append({b.at(j), {1, j}});
    for (std::uint32_t k = 0; k < a.size() && !polygon_.empty(); ++k) {
      if (a.length(k) > 0) clipper_.clip(polygon_, {0, k}, [&](Point p) { return -a.depth(k, p); });
    }
    return polygon_;
  }

 private:
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

  Polygon polygon_;
  Clipper clipper_;
};

/// Divides an overlap into the cells nearest to each side of the master (§3.2.1, Fig. 4). Between sides that
/// share a vertex the division line is the inner bisector (the perpendicular where they are collinear); any
/// other two sides compete by distance too, or a thin master would count its overlap twice.
class CellDivider {
 public:
  /// Calls visit(side, cell) for each master side that owns a part of the overlap.
  template <class Visit>
  void divide(const Piece& master, const Polygon& overlap, const Visit& visit) {
    if (master.is_strip()) {  // all of it lies behind side 0
      if (master.real(0)) visit(0u, overlap);
      return;
    }
    find_competitors(master, overlap);
    for (const std::uint32_t k : competitors_) {
      cell_.assign(overlap);
      for (const std::uint32_t j : competitors_) {
        if (j == k || cell_.empty()) continue;
        cut_towards(master, k, j);
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

  void cut_towards(const Piece& master, std::uint32_t k, std::uint32_t j) {
    const bool before = master.next(k) == j, after = master.next(j) == k;
    if (before || after) {
      const Point vertex = master.at(before ? j : k);
      const Point along = (before ? 1.0 : -1.0) * (master.tangent(k) + master.tangent(j));
      clipper_.clip(cell_, division_line, [&](Point p) { return dot(along, p - vertex); });
      return;
    }
    const Point apart = master.tangent(k) - master.tangent(j);
    if (dot(apart, apart) < 1e-24) return;  // one line: the sides between them divide it
    clipper_.clip(cell_, division_line, [&](Point p) { return master.depth(k, p) - master.depth(j, p); });
  }

  std::vector<std::uint32_t> competitors_;
  std::vector<double> nearest_;
  Polygon cell_;
  Clipper clipper_;
};

}  // namespace talus::overlap
