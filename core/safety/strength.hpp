#pragma once

#include "scene/scene.hpp"

namespace talus {

/// Divides the strength of a material; returns whether it has any. A rigid body has no material to ask.
bool reduce(Choice& model, double factor);

/// The scene with tan φ, cohesion and tensile strength of all interfaces, and of materials that have them,
/// divided by a factor, and a dilation angle no larger than the friction left. Without stages and without
/// velocities at the start. Throws InputError where nothing could be reduced.
Scene with_reduced_strength(const Scene& scene, double factor);

}  // namespace talus
