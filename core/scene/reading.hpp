#pragma once

#include "scene/section.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace talus {

/// What the parts of the reader share: the scene as far as it is read, and names to look up.
struct Reading {
  Registry& registry;
  Mistakes& mistakes;
  Scene scene = {};
  std::map<std::string, std::uint32_t> material_index = {}, body_index = {}, monitor_index = {};
  std::vector<bool> material_has_model = {};  ///< [material] whether it names a model, good or not
  std::vector<bool> sound = {};               ///< [body] whether its polygon can be worked with
  std::vector<std::vector<std::string>> edge_surface = {};  ///< [body][edge of the outer loop] name or ""
};

/// A name that can stand in JSON pointers, lists and column heads. Notes a mistake otherwise.
bool check_name(const std::string& name, const std::string& pointer, Mistakes& mistakes);

/// The index of what `key` names; notes the mistake of an absent, mistyped or unknown name.
std::optional<std::uint32_t> take_reference(Section& section, const std::string& key, const std::string& what,
                                            const std::map<std::string, std::uint32_t>& index);

/// "point" of a body; notes the mistake of a point outside it.
std::optional<Vec2> take_point(const Reading& reading, Section& section, std::optional<std::uint32_t> body);

}  // namespace talus
