#pragma once

#include "scene/reading.hpp"

#include <functional>

namespace talus {

struct Reread {
  Scene scene;
  OrderedJson resolved;
};

/// Reads a scene without stages; notes its mistakes.
using ReadAgain = std::function<Reread(const Json& scene, Mistakes& mistakes)>;

/// "stages": each writes its values into the scene as left by the one before and has it read again, so that
/// whatever holds for a scene holds for each stage. To be called after everything else is read.
void read_stages(Reading& reading, Section& root, const Json& scene, const ReadAgain& read_again);

}  // namespace talus
