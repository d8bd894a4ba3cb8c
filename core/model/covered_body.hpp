#pragma once

#include "model/laid_cover.hpp"
#include "model/model.hpp"

namespace talus {

/// Puts the patches, elements and boundary of a body of many elements into the model. Elements wait for
/// sort_elements. `loaded` are the places of loads on points, relative to the centroid. Throws PluginError
/// where a patch would have no mass.
void add_covered_body(Model& model, const SceneBody& scene_body, std::uint32_t index, LaidCover cover,
                      double density, const std::vector<Vec2>& loaded);

}  // namespace talus
