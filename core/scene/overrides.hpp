#pragma once

#include "scene/mistakes.hpp"
#include "scene/positions.hpp"

#include <optional>
#include <string>
#include <vector>

namespace talus {

/// "/a/b~1c" to "a", "b/c"; nothing for what is no pointer to a part of the scene.
std::optional<std::vector<std::string>> split_pointer(const std::string& pointer);

/// Writes one value to where the keys lead. Where they do not, the scene stays as it is; `missing` is then
/// the pointer of what does not exist and `problem` the reason.
bool write_value(Json& scene, const std::vector<std::string>& keys, Json value, std::string& missing,
                 std::string& problem);

/// Writes the --set values into the scene, in their order. An object that a pointer leads through is
/// made where the scene leaves it out and may have it; any other parent that does not exist is a mistake.
void apply_overrides(Json& scene, const std::vector<Override>& overrides, Mistakes& mistakes);

}  // namespace talus
