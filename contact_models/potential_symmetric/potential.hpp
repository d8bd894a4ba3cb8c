#pragma once

#include <talus/overlap/area_contact.hpp>

namespace talus::potential_symmetric {

using overlap::AreaCentroid;
using overlap::Balance;
using overlap::LoadSink;
using overlap::Overlap;
using overlap::Piece;
using overlap::Point;
using overlap::Polygon;

/// A convex piece as the base of the potential φ: 0 on its sides, 1 at its centroid, linear in between.
/// Forces go with φ h̄, 1/h̄ the mean of 1/h over the boundary, h the height of the centroid over a side: as a
/// mean the slope at the boundary is 1. A strip has the depth behind its one side instead.
class Base {
 public:
  explicit Base(const Piece& piece) : piece_(piece) {
    if (piece.is_strip()) return;
    double twice_area = 0, perimeter = 0;
    Point moment{0, 0};
    const Point origin = piece.at(0);
    for (std::uint32_t i = 0; i < piece.size(); ++i) {
      const Point p = piece.at(i) - origin, q = piece.at(piece.next(i)) - origin;
      twice_area += cross(p, q);
      moment = moment + cross(p, q) * (p + q);
      perimeter += piece.length(i);
    }
    if (!(twice_area > 0)) return;
    centroid_ = origin + (1 / (3 * twice_area)) * moment;
    for (std::uint32_t i = 0; i < piece.size(); ++i) {
      const double height = piece.depth(i, centroid_);
      if (piece.length(i) > 0 && height > 0) slenderness_ += piece.length(i) / height;
    }
    if (slenderness_ > 0) mean_height_ = perimeter / slenderness_;
  }

  bool has_sector(std::uint32_t side) const {
    if (piece_.is_strip()) return side == 0 && piece_.real(0);
    return piece_.length(side) > 0 && mean_height_ > 0 && piece_.depth(side, centroid_) > 0;
  }

  /// φ h̄ over the distance behind the side.
  double slope(std::uint32_t side) const {
    return piece_.is_strip() ? 1 : mean_height_ / piece_.depth(side, centroid_);
  }

  /// Keeps what of a polygon lies in the sector of a side.
  void cut_out(overlap::Clipper& clipper, Polygon& polygon, std::uint32_t side) const {
    if (piece_.is_strip()) return;
    const Point start = piece_.at(side) - centroid_, end = piece_.at(piece_.next(side)) - centroid_;
    clipper.clip(polygon, {overlap::between_sides, 0}, [&](Point p) { return -cross(start, p - centroid_); });
    clipper.clip(polygon, {overlap::between_sides, 0}, [&](Point p) { return cross(end, p - centroid_); });
  }

  /// A force at a point within the sector of a side. On a piece at the ends of the side and the corner
  /// farthest from it, by barycentric weights: exact in force, moment and the work on a uniform strain. On a
  /// strip, whose only real corners are those of its side, at the foot of the point, on the line of action.
  void load(const LoadSink& sink, std::uint32_t side, Point at, Point force) const {
    if (piece_.is_strip()) {
      sink.on_side(piece_, side, piece_.lever(side, at), force);
      return;
    }
    std::uint32_t far = side;
    for (std::uint32_t k = 0; k < piece_.size(); ++k) {
      if (piece_.depth(side, piece_.at(k)) > piece_.depth(side, piece_.at(far))) far = k;
    }
    const double on_far = piece_.depth(side, at) / piece_.depth(side, piece_.at(far));
    const double on_end = piece_.lever(side, at) - on_far * piece_.lever(side, piece_.at(far));
    sink.at_corner(piece_, side, (1 - on_far - on_end) * force);
    sink.at_corner(piece_, piece_.next(side), on_end * force);
    sink.at_corner(piece_, far, on_far * force);
  }

  /// The energy goes with h̄, which a strain of the piece changes: what a uniform displacement gradient does
  /// to it becomes forces at the corners, in balance by themselves. With t along a side of length l, under a
  /// gradient E δl = l t·Et, and h̄ = Σl/Σ(l/h) with l/h = l²/(l h), l h growing as areas do.
  void load_by_height(const LoadSink& sink, double energy) const {
    if (piece_.is_strip() || !(mean_height_ > 0)) return;
    double xx = 0, xy = 0, yy = 0;     // ∂h̄/∂E times Σ(l/h)
    double bxx = 0, bxy = 0, byy = 0;  // Σ of (x − x̄) ⊗ (x − x̄) over the corners
    const Point middle = mean_corner();
    for (std::uint32_t k = 0; k < piece_.size(); ++k) {
      const double height = piece_.depth(k, centroid_), side = piece_.length(k);
      const Point t = piece_.tangent(k), arm = piece_.at(k) - middle;
      bxx += arm.x * arm.x, bxy += arm.x * arm.y, byy += arm.y * arm.y;
      if (!(side > 0) || !(height > 0)) continue;
      const double spread = mean_height_ * side / height, along = side - 2 * spread;
      xx += along * t.x * t.x + spread, xy += along * t.x * t.y, yy += along * t.y * t.y + spread;
    }
    const double determinant = bxx * byy - bxy * bxy;
    if (!(determinant > 0)) return;
    const double factor = -energy / (mean_height_ * slenderness_ * determinant);
    for (std::uint32_t k = 0; k < piece_.size(); ++k) {
      const Point arm = piece_.at(k) - middle;
      const Point weighted{byy * arm.x - bxy * arm.y, bxx * arm.y - bxy * arm.x};
      sink.at_corner(piece_, k,
                     factor * Point{xx * weighted.x + xy * weighted.y, xy * weighted.x + yy * weighted.y});
    }
  }

 private:
  Point mean_corner() const {
    Point sum{0, 0};
    for (std::uint32_t k = 0; k < piece_.size(); ++k) sum = sum + (piece_.at(k) - piece_.at(0));
    return piece_.at(0) + (1.0 / piece_.size()) * sum;
  }

  Piece piece_;
  Point centroid_{0, 0};
  double mean_height_ = 0;  ///< h̄, m
  double slenderness_ = 0;  ///< Σ l/h
};

/// Loads of one overlap with one of its bodies as base, both by half of k φ h̄.
class BaseLoads {
 public:
  /// Adds the loads on body b to `on_b`, as the mean of what acts on it and against what acts on body a; all
  /// loads to `balance`; returns the energy, J/m.
  double apply(const LoadSink& sink, const Overlap& overlap, std::uint32_t base_body, double stiffness,
               Balance& balance, Balance& on_b) {
    const Piece& piece = overlap.piece[base_body];
    const Piece& other = overlap.piece[1 - base_body];
    const Base base(piece);
    double energy = 0;
    for (std::uint32_t side = 0; side < piece.size(); ++side) {
      if (!base.has_sector(side)) continue;
      sector_.assign(overlap.polygon);
      base.cut_out(clipper_, sector_, side);
      if (sector_.empty()) continue;
      const AreaCentroid region = area_centroid(sector_);
      if (!(region.area > 0)) continue;
      const double per_depth = stiffness / 2 * base.slope(side);
      const Point force = -(per_depth * region.area) * piece.normal(side);
      base.load(sink, side, region.centroid, force);
      balance.add(region.centroid, force);
      on_b.add(region.centroid, (base_body == 1 ? 0.5 : -0.5) * force);
      energy += per_depth * region.area * std::max(0.0, piece.depth(side, region.centroid));
      push_other(sink, piece, side, other, 1 - base_body, per_depth, balance, on_b);
    }
    base.load_by_height(sink, energy);
    return energy;
  }

 private:
  /// The boundary of the other body within the sector: a pressure that is linear along each edge.
  void push_other(const LoadSink& sink, const Piece& piece, std::uint32_t side, const Piece& other,
                  std::uint32_t other_body, double per_depth, Balance& balance, Balance& on_b) const {
    for (std::size_t i = 0; i < sector_.size(); ++i) {
      const overlap::SideLabel label = sector_[i].side;
      if (label.body != other_body || !other.real(label.index)) continue;
      const Point at[2] = {sector_[i].at, sector_[sector_.next(i)].at};
      const Point along = at[1] - at[0], inward{-along.y, along.x};  // m, of the edge's length
      const double depth[2] = {std::max(0.0, piece.depth(side, at[0])),
                               std::max(0.0, piece.depth(side, at[1]))};
      for (int end = 0; end < 2; ++end) {
        const Point force = per_depth * (2 * depth[end] + depth[1 - end]) / 6 * inward;
        sink.on_side(other, label.index, other.lever(label.index, at[end]), force);
        balance.add(at[end], force);
        on_b.add(at[end], (other_body == 1 ? 0.5 : -0.5) * force);
      }
    }
  }

  Polygon sector_;
  overlap::Clipper clipper_;
};

}  // namespace talus::potential_symmetric
