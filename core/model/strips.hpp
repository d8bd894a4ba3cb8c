#pragma once

#include "model/model.hpp"
#include "model/motion.hpp"

namespace talus {

/// Gives a body of many elements its pieces: a strip behind each side of its boundary, bounded by the inner
/// bisectors at both ends (§3.2.1, Fig. 4), to a depth of a good part of an element, but never half-way to
/// the opposite side. On a convex stretch a strip also ends where another side a few places on is nearer, so
/// that no overlap counts twice where bisectors cross behind a short side.
void add_strips(Model& model, std::uint32_t body);

/// A strip follows the boundary; corners 0 and 1 of it and of all others of its body must be in place. Its
/// other corners move with these.
void shape_strip(const Model& model, std::uint32_t piece, MotionState& motion);

/// Whether a side lies so near to that of a strip, along a stretch without reflex corner, that their strips
/// only meet inside the body.
bool hang_together(const Model& model, const Strip& strip, std::uint32_t side);

}  // namespace talus
