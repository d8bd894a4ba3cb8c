#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace talus {

/// What stands in a mesh file of Gmsh, before it is asked whether it makes sense.
struct GmshFile {
  struct Node {
    std::uint64_t tag;
    double x, y, z;
    std::size_t line;  ///< where it stands in the file
  };
  struct Cell {
    std::array<std::uint64_t, 3> nodes;  ///< tags; a line has two
    std::int64_t key;                    ///< what `groups_of` wants
    std::size_t line;
  };

  std::string name;  ///< of the file, for messages
  std::vector<Node> nodes;
  std::vector<Cell> lines, triangles;

  /// Names of the physical groups a cell of a dimension (1 lines, 2 triangles) belongs to.
  std::vector<std::string> groups_of(int dimension, std::int64_t key) const;

  using Tag = std::pair<int, std::int64_t>;  ///< dimension, number
  bool by_entity = false;                    ///< MSH 4.1: cells know their entity, entities their groups
  std::map<Tag, std::string> group_names;
  std::map<Tag, std::vector<std::int64_t>> entity_groups;
};

/// Throws InputError with file and line when the text is no MSH 2.2 or 4.1, or holds other elements than
/// points, 2-node lines and 3-node triangles. Needs memory in proportion to the text, whatever it claims.
GmshFile parse_gmsh(std::string_view text, const std::string& name);

}  // namespace talus
