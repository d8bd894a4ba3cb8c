#pragma once

#include "geometry/convex_pieces.hpp"
#include "model/motion.hpp"

#include <vector>

namespace talus::conformance {

/// A body held against a law: its pieces relative to its centre, displaced by u + H X.
struct HeldBody {
  std::vector<ConvexPiece> pieces;
  Vec2 centre;
  BodyMotion motion;
  double mass = 2000;   ///< kg per metre of thickness
  bool strips = false;  ///< the pieces are strips behind the sides of a body of many elements

  Vec2 reference_of(Vec2 world) const { return world - centre; }
};

/// A body from its outline (counter-clockwise), side i of surface class `surfaces[i]` (all 0 if left out).
HeldBody held(const std::vector<Vec2>& outline, const std::vector<std::uint32_t>& surfaces = {});
HeldBody box(double left, double bottom, double right, double top);
/// A ring taken as one convex piece, whatever it is: for shapes that no scene would let pass.
HeldBody held_as_it_is(const std::vector<Vec2>& ring);

/// A convex body as one of many elements shows itself: each side in `parts`, a strip of `depth` behind each.
HeldBody in_strips(const HeldBody& body, int parts, double depth);

/// An isometry of the plane: q, then a shift of all centres.
struct Isometry {
  Matrix2 q{1, 0, 0, 1};
  Vec2 shift{0, 0};
};
Isometry turned_by(double degrees);
Isometry mirrored();
HeldBody moved(const Isometry& isometry, const HeldBody& body);
BodyForce moved(const Isometry& isometry, const BodyForce& force);

}  // namespace talus::conformance
