#pragma once

#include "blocks/lines.hpp"
#include "scene/section.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace talus {

/// Where a scene names a surface of joints.
struct NamingKey {
  std::string surface, pointer;
  std::string drawing;  ///< file of which it is a layer, if it is one
};

/// All that cuts a domain, as a scene gives it.
struct Joints {
  std::vector<JointSet> sets;
  std::vector<Cut> cuts;             ///< "joints" and those of a drawing
  std::string drawing;               ///< its file, if there is one
  std::size_t first_of_drawing = 0;  ///< in cuts; those behind are of it, too
  std::optional<Bricks> bricks;
  std::optional<Sites> sites;
  double split_share = 0;  ///< of quadrilaterals that become triangles
  std::uint64_t split_seed = 0;
  std::vector<std::string> surfaces{""};  ///< names by number
  std::vector<NamingKey> naming_keys;
  std::vector<std::string> warnings;
  std::map<std::string, std::string> files;  ///< Scene::files

  std::uint32_t number_of(const std::string& surface);
};

/// "joint_sets", "joints", "bricks", "voronoi", "split" and "dxf" of a generator.
Joints read_joints(Section& generator, const std::filesystem::path& folder);

}  // namespace talus
