#pragma once

#include "scene/reading.hpp"

#include <set>
#include <string>
#include <vector>

namespace talus {

/// A surface class with the body that it is limited to, where an interface names it as "body/surface".
struct NumberedSurface {
  std::string material, surface, body;
};

/// Gives each edge, of holes too, and each discontinuity its class: equal material and surface name are one
/// class, except for surfaces that `single` names as "body/surface". Notes surfaces and materials of the same
/// name.
std::vector<NumberedSurface> number_surfaces(Reading& reading, const std::set<std::string>& single);

/// [class * surfaces.size() + class] whether two bodies, one of which moves, can meet with these classes, or
/// one body with itself: with its cuts, and with all of its boundary where it has "self_contact". `apart`:
/// also with the outlines of fragments into which its discontinuities may cut it, which its cover decides.
std::vector<bool> meetings(const Scene& scene, bool apart = false);

}  // namespace talus
