#pragma once

#include "model/laid_cover.hpp"
#include "model/model.hpp"

namespace talus {

/// Puts the patches, elements and boundary of a body of many elements into the model. Elements wait in
/// `element_material` order: see sort_elements. Throws PluginError where a patch would have no mass.
void add_covered_body(Model& model, const SceneBody& scene_body, std::uint32_t index, const LaidCover& cover,
                      double density);

}  // namespace talus
