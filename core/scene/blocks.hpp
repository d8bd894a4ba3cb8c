#pragma once

#include "scene/reading.hpp"

#include <map>
#include <string>
#include <vector>

namespace talus {

/// Blocks that a generator has added to the end of "bodies".
struct Generated {
  std::size_t first, count;  ///< entries of "bodies"
  std::string pointer;       ///< of the generator
};

struct Expansion {
  std::vector<Generated> generated;
  std::vector<std::string> unmade;           ///< names of generators that made nothing, for a mistake
  std::map<std::string, std::string> files;  ///< Scene::files
  std::vector<std::string> warnings;         ///< e.g. entities of a drawing that were passed over

  /// Where the scene as it is written has what the expanded one has at `pointer`.
  std::string origin_of(const std::string& pointer) const;
};

/// Replaces the generators in "blocks" by plain bodies. What bodies share (material, cover, ...) is copied as
/// it is written and checked with the bodies; mistakes in the rest are noted, as are generators that would
/// make more than `most_blocks`.
Expansion expand_blocks(Json& scene, const std::filesystem::path& folder, double most_blocks,
                        Mistakes& mistakes);

}  // namespace talus
