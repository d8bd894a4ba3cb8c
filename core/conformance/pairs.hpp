#pragma once

#include "conformance/held_body.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace talus::conformance {

/// Two bodies that overlap, and how they move.
struct HeldPair {
  std::string name;
  std::vector<HeldBody> bodies;
  double depth;  ///< m, about how deep
};

/// Triangles, quadrilaterals and hexagons at random: a corner on a flat, a flat on a flat, a corner on a
/// corner; 1e-4 to 1e-2 m deep. No exact ties, so that they can be turned and mirrored.
std::vector<HeldPair> random_pairs(std::uint32_t count);

/// The awkward ones: chamfers, slivers of 4e-17 m, half bricks, touching sides, collinear subdivided edges,
/// saw teeth, a body in a notch.
std::vector<HeldPair> awkward_pairs();

/// Gives both bodies velocities and rates at random, so that friction and dashpots act.
void set_moving(HeldPair& pair, std::uint64_t seed);

/// A lower saw, teeth up, and an upper one that stands in it by `depth`.
HeldPair saw_teeth(double depth);
/// A block that stands in the notch of another, on its floor and against one wall.
HeldPair body_in_notch(double depth);
/// A box with chamfers of the given size on its lower corners, standing on a wide one at an angle.
HeldPair chamfered(double chamfer, double degrees, double depth);

}  // namespace talus::conformance
