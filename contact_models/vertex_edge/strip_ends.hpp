#pragma once

#include "reflex_corners.hpp"
#include "strips.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace talus::vertex_edge {

/// The corner at which a body of many elements ends, on a side of another.
class CornerOnSide {
 public:
  CornerOnSide(std::span<const PiecePairGeometry> pieces, std::vector<CornerContact>& found,
               CornerContact& contact)
      : found_(found),
        contact_(contact),
        own_(pieces[contact.entry].piece[contact.vertex_body]),
        side_of_(pieces[contact.entry].piece[1 - contact.vertex_body]) {}

  /// Of the side that the corner stands on, the end over which the other body lies has half of what is
  /// covered, in place of half of the side, and the corner has the other half.
  void share_covered() {
    const double ends = share_that_ends();
    // The boundaries run against each other.
    const std::uint32_t under = contact_.vertex;
    if (!(ends > little) || end_of_side(1 - under) != nullptr) return;
    const double along = contact_.lever * side_of_.length(0);
    double covered = std::clamp(under == 1 ? side_of_.length(0) - along : along, 0.0, side_of_.length(0));
    if (CornerContact* const stands = end_of_side(under)) {
      // Nothing where the corner lifts off: the contact ends there without a jump.
      const double pressed = stands->depth > 0 ? std::clamp(2 * contact_.depth / stands->depth, 0.0, 1.0) : 0;
      stands->tributary -= ends * pressed * (side_of_.length(0) - covered) / 2;
    } else {
      covered = std::min(covered, to_other_corner(along));
    }
    contact_.tributary += ends * covered / 2;
  }

 private:
  static constexpr double little = 1e-3;

  /// How much of what lies on the side ends with the corner: all at a right angle, nothing where the boundary
  /// goes straight on; less the less flat it lies.
  double share_that_ends() const {
    const Point along = side_of_.tangent(0);
    const double flat = flatness(own_.tangent(0), along);
    if (!(flat > 0)) return 0;
    const double onward = dot(tangent_beyond(own_, contact_.vertex), along) / dot(own_.tangent(0), along);
    return flat * std::clamp(1 - onward, 0.0, 1.0);
  }

  /// Contact of an end of the side, if it stands on the other body.
  CornerContact* end_of_side(std::uint32_t end) const {
    const std::uint32_t key = 2 * (side_of_.first_corner() + end) + 1 - contact_.vertex_body;
    const auto at =
        std::ranges::find_if(found_, [&](const CornerContact& other) { return other.key == key; });
    return at == found_.end() ? nullptr : &*at;
  }

  /// m, to the corner at which the other body ends on this side, too.
  double to_other_corner(double along) const {
    double least = side_of_.length(0);
    for (const CornerContact& other : found_) {
      if (other.entry == contact_.entry && other.vertex_body == contact_.vertex_body &&
          other.vertex != contact_.vertex)
        least = std::abs(other.lever * side_of_.length(0) - along);
    }
    return least;
  }

  std::vector<CornerContact>& found_;
  CornerContact& contact_;
  const Piece &own_, &side_of_;
};

/// A flat contact between two bodies of many elements: the sides of each bear half of it, every side by its
/// two ends, which have half of it each. A side that the other body covers in part bears by what is covered.
inline void share_covered_sides(std::span<const PiecePairGeometry> pieces,
                                std::vector<CornerContact>& found) {
  for (CornerContact& contact : found) {
    const PiecePairGeometry& both = pieces[contact.entry];
    if (both.piece[0].is_strip() && both.piece[1].is_strip())
      CornerOnSide(pieces, found, contact).share_covered();
  }
}

}  // namespace talus::vertex_edge
