#pragma once

#include "scene/read.hpp"

#include <string>
#include <vector>

namespace talus {

/// A scene of one generator over the unit square, or over `domain`; `rest` are its other keys.
std::string generator_scene(const std::string& rest,
                            const std::string& domain = "[[0, 0], [1, 0], [1, 1], [0, 1]]");

/// The bodies that it makes.
std::vector<SceneBody> made(const std::string& rest,
                            const std::string& domain = "[[0, 0], [1, 0], [1, 1], [0, 1]]");

double area_of(const SceneBody& body);
double area_sum(const std::vector<SceneBody>& bodies);

}  // namespace talus
