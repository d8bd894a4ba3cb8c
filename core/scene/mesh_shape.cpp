#include "scene/mesh_shape.hpp"

#include "geometry/gmsh.hpp"
#include "scene/files.hpp"
#include "scene/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

namespace talus {
namespace {

void take_mesh(GmshMesh mesh, Shape& shape) {
  shape.loops.clear();
  shape.edge_surface.clear();
  for (GmshLoop& loop : mesh.loops) {
    Ring& ring = shape.loops.emplace_back();
    for (const std::uint32_t node : loop.nodes) ring.push_back(mesh.nodes[node]);
    shape.edge_surface.push_back(std::move(loop.surfaces));
  }
  shape.mesh = {std::move(mesh.nodes), std::move(mesh.triangles)};
}

/// Names and coordinates are held to what holds for those in the scene.
bool check_mesh(const Shape& shape, const std::string& file, const std::string& pointer, Mistakes& mistakes) {
  std::set<std::string> names;
  for (const std::vector<std::string>& loop : shape.edge_surface) names.insert(loop.begin(), loop.end());
  names.erase("");
  for (const std::string& name : names) check_name(name, pointer, mistakes);
  const auto beyond = std::find_if(shape.mesh.nodes.begin(), shape.mesh.nodes.end(), [](Vec2 node) {
    return std::max(std::abs(node.x), std::abs(node.y)) > table::largest_coordinate;
  });
  if (beyond == shape.mesh.nodes.end()) return true;
  mistakes.add(pointer, fmt::format("{}: node at ({}, {}) is out of range: expected coordinates up to {} m",
                                    file, beyond->x, beyond->y, table::largest_coordinate));
  return false;
}

}  // namespace

bool read_mesh_shape(Reading& reading, Section& body, Shape& shape) {
  const std::string written =
      body.text("mesh", "the path of a mesh \"file.msh\", or \"file.msh:group\" for a part of it");
  const std::string pointer = body.pointer_to("mesh");
  shape.loops.emplace_back();
  shape.edge_surface.emplace_back();
  if (written.empty()) {
    if (body.resolved["mesh"] == written) reading.mistakes.add(pointer, "\"\" is no path of a mesh file");
    return false;
  }
  const NamedFile named = named_file(reading.folder, written);
  body.resolved["mesh"] = named.resolved;
  if (!is_file(named.file)) {
    reading.mistakes.add(pointer, fmt::format("there is no file {}", named.file.string()));
    return false;
  }
  try {
    take_mesh(read_gmsh(named.file, named.part), shape);
    note_file(reading.scene.files, named.file);
  } catch (const std::runtime_error& failure) {  // InputError or std::system_error
    reading.mistakes.add(pointer, failure.what());
    return false;
  }
  return check_mesh(shape, named.file.string(), pointer, reading.mistakes);
}

}  // namespace talus
