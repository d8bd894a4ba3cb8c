#pragma once

#include "scene/reading.hpp"

#include <filesystem>

namespace talus {

/// "plugins": libraries by path, relative to the scene's folder. They run code, so they are loaded only where
/// the user allowed it. Throws PluginError where an allowed library does not fit.
void read_libraries(Reading& reading, Section& root, const std::filesystem::path& folder, bool allowed);

}  // namespace talus
