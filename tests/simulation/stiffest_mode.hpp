#pragma once

#include "scene/scene.hpp"

#include <vector>

namespace talus {

/// λ_max of M⁻¹K of a scene, rad²/s², by brute force: power iteration on the differences of the forces that
/// the law, the material and the supports give when all bodies are moved a little from `shift`. Tangential
/// springs count, held in stick. A state is linear where the contacts overlap by much more than `amplitude`.
double stiffest_mode(const Scene& scene, const std::vector<Vec2>& shift, double amplitude = 1e-7);

}  // namespace talus
