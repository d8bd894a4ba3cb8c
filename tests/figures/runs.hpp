#pragma once

#include "scene/read.hpp"
#include "verification/course.hpp"
#include "verification/rectangle_mesh.hpp"

#include <string>
#include <vector>

namespace talus::figures {

/// What the program's own plugins bring.
Registry& registry();

/// A scene that ships, by its name, or one from text; with overrides.
Scene shipped(const std::string& name, const std::vector<Override>& overrides = {});
Scene from_text(const std::string& text, const std::vector<Override>& overrides = {});

using verification::body_number;
using verification::Course;
using verification::hash_after;
using verification::RectangleMesh;
using verification::run;
using verification::trouble_of;

}  // namespace talus::figures
