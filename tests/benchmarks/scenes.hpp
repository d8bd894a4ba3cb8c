#pragma once

#include "scene/scene.hpp"

#include <string>

namespace talus::benchmarks {

/// What one measurement runs.
struct Load {
  std::string generator;   ///< script of scenes/generate, with its arguments
  std::string law;         ///< contact law
  bool one_sided = false;  ///< roles by priority instead of both roles: one evaluation of each overlap
  bool sleep = false;      ///< islands at rest sleep
  std::string cover{};     ///< of all bodies, as JSON; empty: that of the script
};

/// What a script of scenes/generate writes, by its name and arguments. Throws std::runtime_error when it
/// fails.
std::string generated(const std::string& generator);

/// The scene of a load, with no end in sight. Throws std::runtime_error when the script fails.
Scene scene_of(const Load& load);

/// A scene given as its text.
Scene scene_of_text(const std::string& text);

}  // namespace talus::benchmarks
