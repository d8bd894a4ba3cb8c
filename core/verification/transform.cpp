#include "verification/transform.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace talus::verification {
namespace {

using MapPoint = std::function<Vec2(Vec2)>;

Scene copied(const Scene& scene) {
  if (!scene.stages.empty()) throw std::logic_error("stages are not transformed");
  Scene copy = scene;
  copy.monitors.clear();
  copy.tolerances.clear();
  return copy;
}

void map_points(Scene& scene, const MapPoint& map) {
  for (SceneBody& body : scene.bodies) {
    each_loop(body, [&](Loop& loop) {
      for (Vec2& vertex : loop.vertices) vertex = map(vertex);
    });
    for (Discontinuity& line : body.discontinuities) {
      for (Vec2& point : line.points) point = map(point);
    }
    for (Vec2& node : body.mesh.nodes) node = map(node);
  }
  for (PointLoad& load : scene.loads) load.point = map(load.point);
}

/// A function of time, times a factor.
Function times(Function function, double factor) {
  for (const Product& term : function.terms) {
    if (term.x || term.y) throw std::logic_error("functions of place are not transformed");
  }
  return factor * std::move(function);
}

/// Directions: (x, y) goes to (sx · x, sy · y), the two swapped before if `swapped`.
struct Directions {
  bool swapped;
  double sx, sy;
  double turn;  ///< sign of rotations

  Vec2 of(Vec2 v) const { return swapped ? Vec2{sx * v.y, sy * v.x} : Vec2{sx * v.x, sy * v.y}; }
};

void map_directions(Scene& scene, const Directions& d) {
  const auto map_functions = [&](VectorFunction& f) {
    if (d.swapped) std::swap(f[0], f[1]);
    f = {times(f[0], d.sx), times(f[1], d.sy)};
  };
  const auto map_optional = [&](std::array<std::optional<Function>, 2>& f) {
    if (d.swapped) std::swap(f[0], f[1]);
    if (f[0]) f[0] = times(*f[0], d.sx);
    if (f[1]) f[1] = times(*f[1], d.sy);
  };
  scene.gravity = d.of(scene.gravity);
  map_functions(scene.base_acceleration);
  for (SceneBody& body : scene.bodies) {
    body.velocity = d.of(body.velocity);
    body.angular_velocity *= d.turn;
    Support& held = body.support;
    if (d.swapped) std::swap(held.x, held.y);
    if (held.x) held.x = d.sx * *held.x;
    if (held.y) held.y = d.sy * *held.y;
    if (held.rotation) held.rotation = d.turn * *held.rotation;
  }
  for (PointLoad& load : scene.loads) map_functions(load.force);
  for (SurfaceLoad& load : scene.surface_loads) map_functions(load.traction);
  for (PrescribedSurface& held : scene.prescribed) {
    map_optional(held.displacement);
    map_optional(held.velocity);
  }
}

/// A parameter of a component by its key, or nothing.
double* value_of(Choice& choice, std::string_view key) {
  if (choice.component == nullptr) return nullptr;
  const Component& component = *choice.component->component;
  for (std::uint32_t i = 0; i < component.parameter_count; ++i) {
    if (component.parameters[i].key == key) return &choice.values[i];
  }
  return nullptr;
}

/// The lattice of a cover goes with its body.
void map_lattices(Scene& scene, const Directions& d, double turn, double sign) {
  for (SceneBody& body : scene.bodies) {
    double *x = value_of(body.cover, "offset_x"), *y = value_of(body.cover, "offset_y"),
           *angle = value_of(body.cover, "angle");
    if (x == nullptr || y == nullptr || angle == nullptr) continue;
    const Vec2 offset = d.of({*x, *y});
    *x = offset.x;
    *y = offset.y;
    *angle = sign * *angle + turn;
  }
}

/// Powers of length, mass and time.
struct Dimension {
  int length, mass, time;
};

/// Of a unit as tables of parameters write it.
Dimension dimension_of(std::string_view unit) {
  constexpr std::pair<std::string_view, Dimension> known[] = {
      {"-", {0, 0, 0}},    {"deg", {0, 0, 0}},    {"m", {1, 0, 0}},     {"s", {0, 0, 1}},
      {"1/s", {0, 0, -1}}, {"m/s", {1, 0, -1}},   {"m/s2", {1, 0, -2}}, {"kg/m3", {-2, 1, 0}},
      {"Pa", {0, 1, -2}},  {"Pa/m", {-1, 1, -2}}, {"N/m", {1, 1, -2}},  {"N/m per m", {0, 1, -2}},
  };
  for (const auto& [name, dimension] : known) {
    if (unit == name) return dimension;
  }
  throw std::logic_error(fmt::format("unit '{}' is not transformed", unit));
}

class Scaling {
 public:
  explicit Scaling(Units units) : units_(units) {}

  double by(Dimension d) const {
    return std::ldexp(1.0, d.length * units_.length + d.mass * units_.mass + d.time * units_.time);
  }
  void operator()(double& value, const char* unit) const { value *= by(dimension_of(unit)); }
  void operator()(Vec2& value, const char* unit) const {
    (*this)(value.x, unit);
    (*this)(value.y, unit);
  }
  void operator()(Function& function, const char* unit) const {
    for (const Product& term : function.terms) {
      if (term.time) throw std::logic_error("functions of time are not transformed");
    }
    function = times(function, by(dimension_of(unit)));
  }
  void operator()(VectorFunction& f, const char* unit) const {
    for (Function& each : f) (*this)(each, unit);
  }
  template <class T>
  void operator()(std::optional<T>& value, const char* unit) const {
    if (value) (*this)(*value, unit);
  }
  void operator()(const Parameter* parameters, std::uint32_t count, std::vector<double>& values) const {
    for (std::uint32_t i = 0; i < count; ++i) (*this)(values[i], parameters[i].unit);
  }
  void operator()(Choice& choice) const {
    if (choice.component == nullptr) return;
    const Component& component = *choice.component->component;
    (*this)(component.parameters, component.parameter_count, choice.values);
  }
  void operator()(Damping& damping) const { (*this)(damping.constant, "1/s"); }

 private:
  Units units_;
};

}  // namespace

Scene moved_by(const Scene& scene, Vec2 by) {
  Scene copy = copied(scene);
  map_directions(copy, {false, 1, 1, 1});  // refuses functions of place
  map_points(copy, [&](Vec2 p) { return p + by; });
  return copy;
}

Scene turned(const Scene& scene) {
  Scene copy = copied(scene);
  const Directions quarter{true, -1, 1, 1};
  map_points(copy, [&](Vec2 p) { return quarter.of(p); });
  map_directions(copy, quarter);
  map_lattices(copy, quarter, std::numbers::pi / 2, 1);
  return copy;
}

Scene mirrored(const Scene& scene) {
  Scene copy = copied(scene);
  const Directions mirror{false, -1, 1, -1};
  map_points(copy, [&](Vec2 p) { return mirror.of(p); });
  map_directions(copy, mirror);
  map_lattices(copy, mirror, 0, -1);
  const auto other_way_round = [](Loop& loop) {
    std::reverse(loop.vertices.begin(), loop.vertices.end());
    // Edge i runs from vertex i to the next, so that the last one stays the last.
    std::reverse(loop.surface_class.begin(), loop.surface_class.end() - 1);
  };
  for (SceneBody& body : copy.bodies) {
    each_loop(body, other_way_round);
    for (auto& corners : body.mesh.corners) std::swap(corners[1], corners[2]);
  }
  return copy;
}

Scene reordered(const Scene& scene, const std::vector<std::size_t>& order) {
  Scene copy = copied(scene);
  std::vector<std::uint32_t> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    copy.bodies[i] = scene.bodies[order[i]];
    place[order[i]] = static_cast<std::uint32_t>(i);
  }
  for (PointLoad& load : copy.loads) load.body = place[load.body];
  for (SurfaceLoad& load : copy.surface_loads) load.body = place[load.body];
  for (PrescribedSurface& held : copy.prescribed) held.body = place[held.body];
  for (AbsorbingSurface& surface : copy.absorbing) surface.body = place[surface.body];
  return copy;
}

Scene boosted(const Scene& scene, Vec2 velocity) {
  Scene copy = copied(scene);
  for (SceneBody& body : copy.bodies) {
    if (body.fixed || body.support.x || body.support.y)
      throw std::logic_error("a held body cannot be boosted");
    body.velocity += velocity;
  }
  return copy;
}

Scene in_units(const Scene& scene, Units units) {
  Scene copy = copied(scene);
  const Scaling scale(units);
  map_points(copy, [&](Vec2 p) {
    scale(p, "m");
    return p;
  });
  scale(copy.gravity, "m/s2");
  for (SceneMaterial& material : copy.materials) {
    scale(material.density, "kg/m3");
    scale(material.model);
  }
  scale(copy.contact);
  if (copy.contact.component != nullptr) {
    const Component& law = *copy.contact.component->component;
    for (std::vector<double>& values : copy.interface_values)
      scale(law.interface_parameters, law.interface_parameter_count, values);
  }
  for (SceneBody& body : copy.bodies) {
    scale(body.cover);
    scale(body.velocity, "m/s");
    scale(body.angular_velocity, "1/s");
    scale(body.support.x, "m/s");
    scale(body.support.y, "m/s");
    scale(body.support.rotation, "1/s");
  }
  for (PointLoad& load : copy.loads) scale(load.force, "N/m");
  for (SurfaceLoad& load : copy.surface_loads) {
    scale(load.traction, "Pa");
    scale(load.pressure, "Pa");
  }
  for (PrescribedSurface& held : copy.prescribed) {
    scale(held.stiffness, "Pa/m");
    scale(held.ramp, "s");
    for (auto& each : held.displacement) scale(each, "m");
    for (auto& each : held.velocity) scale(each, "m/s");
  }
  scale(copy.base_acceleration, "m/s2");
  scale(copy.damping);
  if (copy.settle) {
    scale(copy.settle->duration, "s");
    scale(copy.settle->damping);
  }
  if (copy.sleep) {
    scale(copy.sleep->speed, "m/s");
    scale(copy.sleep->acceleration, "m/s2");
    scale(copy.sleep->after, "s");
  }
  scale(copy.time.end, "s");
  scale(copy.time.dt, "s");
  scale(copy.output.history, "s");
  scale(copy.output.frames, "s");
  return copy;
}

}  // namespace talus::verification
