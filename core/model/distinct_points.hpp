#pragma once

#include "model/model.hpp"

#include <cstdint>
#include <vector>

namespace talus {

/// Numbers of the points of a body of many elements, ring after ring (Model::element_region) of one element
/// after the other (Model::body_element): from 0 in the order in which they appear, and the same one for
/// points that always move together, since they lie at one place X and hang on the same patches. The faces of
/// a discontinuity lie at one place, too, but hang on different ones.
std::vector<std::uint32_t> distinct_points(const Model& model, std::uint32_t body);

}  // namespace talus
