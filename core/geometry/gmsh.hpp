#pragma once

#include "geometry/vec2.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// A closed part of a mesh's boundary, with the body on its left.
struct GmshLoop {
  std::vector<std::uint32_t> nodes;
  std::vector<std::string> surfaces;  ///< [side] of the side that starts at node i; "" where it has no name
};

/// Triangles that are one connected part of the plane, and their boundary.
struct GmshMesh {
  std::vector<Vec2> nodes;                              ///< m, as written in the file; each is used
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise
  std::vector<GmshLoop> loops;  ///< the outer one, counter-clockwise, then the holes, clockwise
};

/// Reads the 3-node triangles of a mesh file of Gmsh, MSH 2.2 or 4.1 as text; with `group`, those of that
/// physical group alone. Physical groups of lines name the sides of the boundary; a group without a name goes
/// by its number. Order is that of the file. Throws InputError, with file and line, when the file is no such
/// mesh or the triangles are no single, flat part without overlaps; std::system_error when it cannot be read.
GmshMesh read_gmsh(const std::filesystem::path& file, const std::string& group = "");
GmshMesh read_gmsh_text(std::string_view text, const std::string& name, const std::string& group = "");

}  // namespace talus
