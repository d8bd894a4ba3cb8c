#pragma once

#include "reflex_corners.hpp"
#include "strips.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace talus::vertex_edge {

/// A corner at which one body of many elements ends, on a side of the other.
struct CornerOnSide {
  std::uint32_t contact;  ///< which of those found
  std::uint32_t side_of;  ///< first corner of the strip behind that side
  double along;           ///< m, from its start
  bool forward;           ///< its body lies over what follows on the side, or over what comes before
  double ends;            ///< how much of that body ends there, 0 to 1
};

/// A flat contact between two bodies of many elements: the sides of each bear half of it, every side by its
/// two ends, which have half of its length each. Of a side that the other body covers in part, each stretch
/// that is covered bears by what stands at its ends: an end of the side, or a corner of the other body.
class CoveredSides {
 public:
  CoveredSides(std::span<const PiecePairGeometry> pieces, std::vector<CornerContact>& found,
               std::vector<CornerOnSide>& corners)
      : pieces_(pieces), found_(found), corners_(corners) {}

  void share() {
    list_corners();
    if (corners_.empty()) return;
    for (CornerContact& contact : found_) {
      if (is_between_strips(contact)) lessen(contact);
    }
    for (const CornerOnSide& corner : corners_) add_to(corner);
  }

 private:
  static constexpr double little = 1e-3;

  const Piece& own(const CornerContact& contact) const {
    return pieces_[contact.entry].piece[contact.vertex_body];
  }
  const Piece& side_of(const CornerContact& contact) const {
    return pieces_[contact.entry].piece[1 - contact.vertex_body];
  }
  bool is_between_strips(const CornerContact& contact) const {
    return own(contact).is_strip() && side_of(contact).is_strip();
  }

  void list_corners() {
    corners_.clear();
    for (std::uint32_t i = 0; i < found_.size(); ++i) {
      const CornerContact& contact = found_[i];
      if (!is_between_strips(contact)) continue;
      const double ends = share_that_ends(contact);
      const Piece& met = side_of(contact);
      // The boundaries run against each other.
      if (ends > little)
        corners_.push_back({i, met.first_corner(), contact.lever * met.length(0), contact.vertex == 1, ends});
    }
  }

  /// All of what lies on the side at a right angle, nothing where the boundary goes straight on; less the
  /// less flat it lies.
  double share_that_ends(const CornerContact& contact) const {
    const Piece& strip = own(contact);
    const Point along = side_of(contact).tangent(0);
    const double flat = flatness(strip.tangent(0), along);
    if (!(flat > 0)) return 0;
    const double onward = dot(tangent_beyond(strip, contact.vertex), along) / dot(strip.tangent(0), along);
    return flat * std::clamp(1 - onward, 0.0, 1.0);
  }

  /// An end of a side: what is covered goes as far as the next corner whose body lies between, or begins at a
  /// corner with which the end is flush. Where the faces of a crack end on a side both are there.
  void lessen(CornerContact& end) const {
    const Piece& side = own(end);
    const double length = side.length(0), at = end.vertex == 0 ? 0 : length;
    const CornerOnSide *covers = nullptr, *begins = nullptr;
    const auto away = [at](const CornerOnSide& corner) { return std::abs(corner.along - at); };
    for (const CornerOnSide& corner : corners_) {
      if (!lies_on(corner, side.first_corner(), end.vertex_body)) continue;
      const CornerOnSide*& nearest = corner.forward == (end.vertex == 1) ? covers : begins;
      if (nearest == nullptr || away(corner) < away(*nearest)) nearest = &corner;
    }
    const bool is_flush = begins != nullptr && away(*begins) <= 2 * flush * length &&
                          (covers == nullptr || away(*begins) < away(*covers));
    const CornerOnSide* const next = is_flush ? begins : covers;
    if (next == nullptr) return;
    const CornerContact& there = found_[next->contact];
    if (!there.bonded && !(end.depth > 0)) return;
    const double share = is_flush ? 0 : std::clamp(away(*next) / length, 0.0, 1.0);
    // Nothing is taken where the corner lifts off: the contact ends there without a jump. A bond breaks.
    const double pressed = there.bonded ? 1 : std::clamp(2 * there.depth / end.depth, 0.0, 1.0);
    end.tributary *= 1 - next->ends * pressed * (1 - share);
  }

  /// A corner has half of the stretch of the side that its body covers from there on.
  void add_to(const CornerOnSide& corner) const {
    CornerContact& contact = found_[corner.contact];
    const Piece& side = side_of(contact);
    const double length = own(contact).length(0), nothing = std::numeric_limits<double>::infinity();
    const double whole = corner.forward ? side.length(0) - corner.along : corner.along;
    double covered =
        stands(side.first_corner() + (corner.forward ? 1 : 0), 1 - contact.vertex_body) ? whole : nothing;
    for (const CornerOnSide& other : corners_) {
      if (!lies_on(other, corner.side_of, 1 - contact.vertex_body) || other.forward == corner.forward)
        continue;
      // No body is narrower than one of its sides: what is nearer is the other face of a crack.
      const double away = (other.along - corner.along) * (corner.forward ? 1 : -1);
      if (away > length / 2) covered = std::min(covered, away);
    }
    if (covered == nothing) covered = reach_of(corner, whole);
    contact.tributary += corner.ends * std::max(0.0, covered) / 2;
  }

  /// m, how far the contact goes on from a corner towards an end of the side that has lifted off: to where
  /// the line through the corner and the furthest vertex that still stands there comes up; along its own
  /// side, if there is none.
  double reach_of(const CornerOnSide& corner, double whole) const {
    const CornerContact& contact = found_[corner.contact];
    const double least = std::min(whole, own(contact).length(0));
    double furthest = 0, depth = 0;
    for (const CornerContact& other : found_) {
      if (!is_between_strips(other) || other.vertex_body != contact.vertex_body ||
          side_of(other).first_corner() != corner.side_of)
        continue;
      const double along = other.lever * side_of(other).length(0) - corner.along,
                   away = corner.forward ? along : -along;
      if (away > furthest) furthest = away, depth = other.depth;
    }
    if (!(furthest > 0 && contact.depth > 0)) return least;
    const double rise = contact.depth - depth;
    return rise > 0 ? std::clamp(furthest * contact.depth / rise, least, whole) : whole;
  }

  /// Whether a corner lies on a side of `body`.
  bool lies_on(const CornerOnSide& corner, std::uint32_t side, std::uint32_t body) const {
    return corner.side_of == side && found_[corner.contact].vertex_body != body;
  }

  /// Whether an end of a side stands on the other body.
  bool stands(std::uint32_t corner, std::uint32_t body) const {
    const std::uint32_t key = 2 * corner + body;
    return std::ranges::any_of(found_, [&](const CornerContact& contact) { return contact.key == key; });
  }

  std::span<const PiecePairGeometry> pieces_;
  std::vector<CornerContact>& found_;
  std::vector<CornerOnSide>& corners_;
};

}  // namespace talus::vertex_edge
