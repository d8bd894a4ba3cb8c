#include "scene/loops.hpp"

#include "scene/mesh_shape.hpp"
#include "scene/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

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

/// A surface is a list of edge numbers under a name. Edges of holes are numbered on after those of the
/// polygon.
class EdgeNames {
 public:
  EdgeNames(const std::vector<std::size_t>& edge_counts, Mistakes& mistakes) : mistakes_(mistakes) {
    for (const std::size_t count : edge_counts) {
      names_.emplace_back(count);
      total_ += count;
    }
  }

  void take(const std::string& name, const Json& edges, const std::string& pointer) {
    check_name(name, pointer, mistakes_);
    if (!edges.is_array()) {
      mistakes_.add(pointer,
                    fmt::format("{} is not allowed here: expected a list of edge numbers", shown(edges)));
      return;
    }
    for (std::size_t i = 0; i < edges.size(); ++i) take_edge(name, edges[i], below(pointer, i));
  }

  std::vector<std::vector<std::string>> names() && { return std::move(names_); }

 private:
  void take_edge(const std::string& name, const Json& edge, const std::string& pointer) {
    if (total_ == 0) return;  // the polygon's own mistake
    if (!edge.is_number_unsigned() || edge.get<std::uint64_t>() >= total_) {
      mistakes_.add(pointer, fmt::format("there is no edge {}: expected a whole number from 0 to {}",
                                         shown(edge), total_ - 1));
      return;
    }
    std::string& owner = at(edge.get<std::size_t>());
    if (!owner.empty()) {
      mistakes_.add(pointer,
                    fmt::format("edge {} belongs to surface \"{}\" already: an edge has one surface at most",
                                shown(edge), owner));
    }
    owner = name;
  }

  std::string& at(std::size_t edge) {
    std::size_t loop = 0;
    for (; edge >= names_[loop].size(); ++loop) edge -= names_[loop].size();
    return names_[loop][edge];
  }

  Mistakes& mistakes_;
  std::vector<std::vector<std::string>> names_;
  std::size_t total_ = 0;
};

/// Turns a loop round and keeps its first vertex: the edge from vertex k is the one that led to n - k before.
void turn(Ring& ring, std::vector<std::string>& edges) {
  std::reverse(ring.begin() + 1, ring.end());
  std::reverse(edges.begin(), edges.end());
}

/// The outer loop under its key, "holes" and "surfaces" as written. Returns whether the loops can be looked
/// at.
bool read_loops(Section& body, const char* outer, const char* expected, Shape& shape) {
  bool good = true;
  std::vector<std::size_t> edge_counts;
  const auto take_loop = [&](const Json& loop, const std::string& pointer) {
    shape.loops.push_back(read_ring(loop, pointer, body.mistakes(), good));
    edge_counts.push_back(loop.is_array() ? loop.size() : 0);
  };
  const Json* polygon = body.required_child(outer, expected);
  if (polygon == nullptr) {
    good = false;
    shape.loops.emplace_back();
    edge_counts.push_back(0);
  } else {
    body.resolved[outer] = *polygon;
    take_loop(*polygon, body.pointer_to(outer));
  }
  body.list("holes", "a list of polygons [[[x, y], ...], ...]", take_loop);
  if (const Json* holes = body.child("holes")) body.resolved["holes"] = *holes;
  EdgeNames names(edge_counts, body.mistakes());
  body.members("surfaces", "an object of lists of edge numbers {\"top\": [0, 1]}",
               [&](const std::string& name, const Json& edges, const std::string& pointer) {
                 names.take(name, edges, pointer);
               });
  if (const Json* written = body.child("surfaces")) body.resolved["surfaces"] = *written;
  shape.edge_surface = std::move(names).names();
  return good;
}

/// "mesh" and nothing beside it.
bool read_mesh(Reading& reading, Section& body, Shape& shape) {
  for (const char* key : {"polygon", "holes", "surfaces"}) {
    if (!body.has(key)) continue;
    body.child(key);
    body.mistakes().add_at_key(
        body.pointer_to(key),
        fmt::format("the body has its shape and its surfaces from \"mesh\", which leaves "
                    "nothing for \"{}\": keep one of the two",
                    key));
  }
  return read_mesh_shape(reading, body, shape);
}

/// Reports what keeps the shape from bounding a body, at `outer` or at its holes; else turns its loops.
void check_loops(Section& body, const std::string& outer, bool whole, Shape& shape) {
  const std::vector<ShapeFault> faults = shape_faults(shape.loops);
  for (const ShapeFault& fault : faults) {
    std::string pointer = body.pointer_to(outer);
    if (!whole && fault.loop != 0) pointer = below(body.pointer_to("holes"), fault.loop - 1);
    if (!whole && fault.vertex) pointer = below(pointer, *fault.vertex);
    body.mistakes().add(pointer, fault.message);
  }
  shape.sound = faults.empty();
  if (!shape.sound) return;
  for (std::size_t loop = 0; loop < shape.loops.size(); ++loop) {
    const bool counter_clockwise = signed_area(shape.loops[loop]) > 0;
    if (counter_clockwise != (loop == 0)) turn(shape.loops[loop], shape.edge_surface[loop]);
  }
}

}  // namespace

Shape read_shape(Reading& reading, Section& body) {
  Shape shape;
  const bool meshed = body.child("mesh") != nullptr;
  const bool good =
      meshed ? read_mesh(reading, body, shape)
             : read_loops(body, "polygon",
                          "a list of vertices [[x, y], ...] [m], or \"mesh\" with the path of a file", shape);
  if (good) check_loops(body, meshed ? "mesh" : "polygon", meshed, shape);
  return shape;
}

Shape read_domain(Section& generator) {
  Shape shape;
  if (read_loops(generator, "domain", "a list of vertices [[x, y], ...] [m]", shape))
    check_loops(generator, "domain", false, shape);
  return shape;
}

}  // namespace talus
