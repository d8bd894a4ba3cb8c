#pragma once

#include "scene/section.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace talus {

/// Names of the surfaces of a body, "" where a side has none.
struct SurfaceNames {
  std::vector<std::vector<std::string>> edges = {};  ///< [loop][edge], the outer loop first
  std::vector<std::string> discontinuities = {};

  std::set<std::string> all() const;  ///< without ""
};

/// What the parts of the reader share: the scene as far as it is read, and names to look up.
struct Reading {
  Registry& registry;
  Mistakes& mistakes;
  std::filesystem::path folder = {};  ///< of the scene; paths of files start there
  Scene scene = {};
  std::map<std::string, std::uint32_t> material_index = {}, body_index = {}, monitor_index = {};
  std::vector<bool> material_has_model = {};     ///< [material] whether it names a model, good or not
  std::vector<bool> sound = {};                  ///< [body] whether its polygon can be worked with
  std::vector<SurfaceNames> surface_names = {};  ///< [body]
  /// [body] the class of each named surface; known once the surfaces are numbered.
  std::vector<std::map<std::string, std::uint32_t>> surface_class = {};
  std::size_t table_points = 0;  ///< read so far, of all tables
  std::vector<std::string> unmade =
      {};  ///< generators of blocks that failed: what they name is not asked for
};

/// A name that can stand in JSON pointers, lists and column heads. Notes a mistake otherwise.
bool check_name(const std::string& name, const std::string& pointer, Mistakes& mistakes);

/// The name of the section, of `what`; nothing where it is missing or no text, which is noted.
std::optional<std::string> take_name(Section& section, const std::string& what);

/// The index of what `key` names; notes the mistake of an absent, mistyped or unknown name.
std::optional<std::uint32_t> take_reference(Section& section, const std::string& key, const std::string& what,
                                            const std::map<std::string, std::uint32_t>& index);

/// The body that "body" names; notes the mistake unless it may be a block of a generator that failed.
std::optional<std::uint32_t> take_body(const Reading& reading, Section& section);

/// The class of the surface of the body that "surface" names; notes the mistake of an absent or unknown name.
std::optional<std::uint32_t> take_surface(Reading& reading, Section& section,
                                          std::optional<std::uint32_t> body);

/// "point" of a body; notes the mistake of a point outside it.
std::optional<Vec2> take_point(const Reading& reading, Section& section, std::optional<std::uint32_t> body);

}  // namespace talus
