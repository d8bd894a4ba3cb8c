#include "scene/loops.hpp"

#include "scene/tables.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace talus {
namespace {

Ring read_ring(const Json& value, const std::string& pointer, Mistakes& mistakes, bool& good) {
  Ring ring;
  if (!value.is_array()) {
    mistakes.add(pointer, fmt::format("{} is not allowed here: expected a list of vertices [[x, y], ...] [m]",
                                      shown(value)));
    good = false;
    return ring;
  }
  if (value.size() < 3) {
    mistakes.add(pointer,
                 fmt::format("{} vertices enclose no area: expected at least 3 [x, y]", value.size()));
    good = false;
  }
  for (std::size_t i = 0; i < value.size(); ++i) {
    const auto vertex = take_pair(table::coordinate, value[i], below(pointer, i), mistakes);
    if (vertex) ring.push_back({(*vertex)[0], (*vertex)[1]});
    if (!vertex) good = false;
  }
  return ring;
}

/// Names of the edges as written. Surfaces are lists of edge numbers under a name.
std::vector<std::string> read_surfaces(Section& body, std::size_t edge_count) {
  std::vector<std::string> names(edge_count);
  Mistakes& mistakes = body.mistakes();
  const std::string what = "an object of lists of edge numbers {\"top\": [0, 1]}";
  body.members("surfaces", what, [&](const std::string& name, const Json& edges, const std::string& pointer) {
    check_name(name, pointer, mistakes);
    if (!edges.is_array()) {
      mistakes.add(pointer,
                   fmt::format("{} is not allowed here: expected a list of edge numbers", shown(edges)));
      return;
    }
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const std::string at = below(pointer, i);
      if (!edges[i].is_number_unsigned() || edges[i].get<std::uint64_t>() >= edge_count) {
        if (edge_count == 0) continue;  // the polygon's own mistake
        mistakes.add(at, fmt::format("there is no edge {}: expected a whole number from 0 to {}",
                                     shown(edges[i]), edge_count - 1));
        continue;
      }
      std::string& owner = names[edges[i].get<std::size_t>()];
      if (!owner.empty()) {
        mistakes.add(at,
                     fmt::format("edge {} belongs to surface \"{}\" already: an edge has one surface at most",
                                 shown(edges[i]), owner));
      }
      owner = name;
    }
  });
  if (const Json* written = body.child("surfaces")) body.resolved["surfaces"] = *written;
  return names;
}

/// Turns a loop round and keeps its first vertex: the edge from vertex k is the one that led to n - k before.
template <class Item>
void turn_edges(std::vector<Item>& edges) {
  std::reverse(edges.begin(), edges.end());
}

void turn(Ring& ring) {
  std::reverse(ring.begin() + 1, ring.end());
}

}  // namespace

Shape read_shape(Section& body) {
  Shape shape;
  Mistakes& mistakes = body.mistakes();
  bool good = true;
  const Json* polygon = body.required_child("polygon", "a list of vertices [[x, y], ...] [m]");
  if (polygon == nullptr) {
    good = false;
    shape.loops.emplace_back();
  } else {
    body.resolved["polygon"] = *polygon;
    shape.loops.push_back(read_ring(*polygon, body.pointer_to("polygon"), mistakes, good));
  }
  body.list("holes", "a list of polygons [[[x, y], ...], ...]",
            [&](const Json& hole, const std::string& pointer) {
              shape.loops.push_back(read_ring(hole, pointer, mistakes, good));
            });
  if (const Json* holes = body.child("holes")) body.resolved["holes"] = *holes;
  shape.edge_surface = read_surfaces(body, polygon != nullptr && polygon->is_array() ? polygon->size() : 0);
  if (!good) return shape;

  const std::vector<ShapeFault> faults = shape_faults(shape.loops);
  for (const ShapeFault& fault : faults) {
    std::string pointer =
        fault.loop == 0 ? body.pointer_to("polygon") : below(body.pointer_to("holes"), fault.loop - 1);
    if (fault.vertex) pointer = below(pointer, *fault.vertex);
    mistakes.add(pointer, fault.message);
  }
  shape.sound = faults.empty();
  if (!shape.sound) return shape;
  for (std::size_t loop = 0; loop < shape.loops.size(); ++loop) {
    const bool counter_clockwise = signed_area(shape.loops[loop]) > 0;
    if (counter_clockwise == (loop == 0)) continue;
    turn(shape.loops[loop]);
    if (loop == 0) turn_edges(shape.edge_surface);
  }
  return shape;
}

}  // namespace talus
