#pragma once

#include "plugin/registry.hpp"
#include "scene/section.hpp"

namespace talus {

/// JSON Schema (2020-12) of scenes for the components of the registry. It refuses what the reader refuses for
/// the keys of an object, their types and ranges; names, geometry and files are left to the reader.
OrderedJson scene_schema(const Registry& registry);

}  // namespace talus
