#pragma once

#include "scene/scene.hpp"

#include <cstddef>
#include <vector>

namespace talus::verification {

// The same scene as another observer sees it. What comes out must be the same, seen that way. Monitors are
// left out, stages and functions of place are not provided for: std::logic_error.

Scene moved_by(const Scene& scene, Vec2 by);
/// By a quarter, counter-clockwise.
Scene turned(const Scene& scene);
/// Left for right.
Scene mirrored(const Scene& scene);
/// Bodies in another order; the one at order[i] comes i-th.
Scene reordered(const Scene& scene, const std::vector<std::size_t>& order);
/// From a frame that moves with −velocity; without fixed or supported bodies.
Scene boosted(const Scene& scene, Vec2 velocity);

/// Units 2^length, 2^mass and 2^time times as small: numbers of SI change by powers of two. Mass is that per
/// metre of thickness, which is no length here.
struct Units {
  int length, mass, time;
};
Scene in_units(const Scene& scene, Units units);

}  // namespace talus::verification
