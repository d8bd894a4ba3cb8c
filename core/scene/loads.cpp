#include "scene/loads.hpp"

#include "scene/nearest.hpp"
#include "scene/polygons.hpp"
#include "scene/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace talus {
namespace {

void check_moves(Reading& reading, Section& section, std::optional<std::uint32_t> body) {
  if (!body || !reading.scene.bodies[*body].fixed) return;
  reading.mistakes.add(
      section.pointer_to("body"),
      fmt::format("body \"{}\" is fixed: expected one that moves", reading.scene.bodies[*body].name));
}

/// A class of the body's edges named `surface`.
std::optional<std::uint32_t> find_surface(Reading& reading, Section& section, std::uint32_t body,
                                          const std::string& surface) {
  const std::vector<std::string>& names = reading.edge_surface[body];
  const std::vector<std::uint32_t>& classes = reading.scene.bodies[body].outer.surface_class;
  const auto found = std::find(names.begin(), names.end(), surface);
  if (found != names.end()) {
    const auto edge = static_cast<std::size_t>(found - names.begin());
    return edge < classes.size() ? std::optional(classes[edge]) : std::nullopt;
  }
  std::set<std::string> known(names.begin(), names.end());
  known.erase("");
  const std::vector<std::string> list(known.begin(), known.end());
  reading.mistakes.add(
      section.pointer_to("surface"),
      fmt::format("body \"{}\" has no surface \"{}\";{} it has: {}", reading.scene.bodies[body].name, surface,
                  did_you_mean(surface, list), listed(list)));
  return std::nullopt;
}

/// A motion per axis; null leaves an axis free.
std::array<std::optional<double>, 2> read_motion(Section& section, const Parameter& parameter) {
  std::array<std::optional<double>, 2> motion;
  const Json* written = section.child(parameter.key);
  section.resolved[parameter.key] = OrderedJson::array({nullptr, nullptr});
  if (written == nullptr) return motion;
  section.resolved[parameter.key] = *written;
  const auto taken =
      take_pair(parameter, *written, section.pointer_to(parameter.key), section.mistakes(), true);
  for (std::size_t axis = 0; taken && axis < 2; ++axis) {
    if (!std::isnan((*taken)[axis])) motion[axis] = (*taken)[axis];
  }
  return motion;
}

PrescribedSurface read_one_prescribed(Reading& reading, Section& section) {
  PrescribedSurface one{};
  const auto body = take_reference(section, "body", "body", reading.body_index);
  check_moves(reading, section, body);
  const std::string surface = section.text("surface", "the name of a surface of the body");
  if (body && !surface.empty()) {
    one.body = *body;
    one.surface_class = find_surface(reading, section, *body, surface).value_or(0);
  }
  one.stiffness = section.value(table::of(table::prescribed, "stiffness"));
  one.ramp = section.value(table::of(table::prescribed, "ramp"));
  const std::size_t mistakes_before = reading.mistakes.count();
  one.displacement = read_motion(section, table::of(table::prescribed, "displacement"));
  one.velocity = read_motion(section, table::of(table::prescribed, "velocity"));
  const bool nothing = !one.displacement[0] && !one.displacement[1] && !one.velocity[0] && !one.velocity[1];
  if (nothing && reading.mistakes.count() == mistakes_before) {
    reading.mistakes.add(section.pointer(),
                         "nothing is prescribed: expected \"displacement\": [ux, uy] [m] or "
                         "\"velocity\": [vx, vy] [m/s] with a number on one axis at least");
  }
  section.finish();
  return one;
}

}  // namespace

void read_loads(Reading& reading, Section& root) {
  OrderedJson resolved = OrderedJson::array();
  root.list("loads", "a list of loads [{\"body\": ..., \"point\": ..., \"force\": ...}]",
            [&](const Json& value, const std::string& pointer) {
              Section section(&value, pointer, reading.mistakes);
              const auto body = take_reference(section, "body", "body", reading.body_index);
              check_moves(reading, section, body);
              const Vec2 point = take_point(reading, section, body).value_or(Vec2{});
              if (!section.has("point")) section.pair(table::coordinate);
              const Vec2 force = section.pair(table::of(table::load, "force"));
              section.finish();
              reading.scene.loads.push_back({body.value_or(0), point, force});
              resolved.push_back(section.resolved);
            });
  root.resolved["loads"] = std::move(resolved);
}

void read_prescribed(Reading& reading, Section& root) {
  OrderedJson resolved = OrderedJson::array();
  const std::string what =
      "a list of surfaces in prescribed motion [{\"body\": ..., \"surface\": ..., \"stiffness\": ...}]";
  root.list("prescribed", what, [&](const Json& value, const std::string& pointer) {
    Section section(&value, pointer, reading.mistakes);
    reading.scene.prescribed.push_back(read_one_prescribed(reading, section));
    resolved.push_back(section.resolved);
  });
  root.resolved["prescribed"] = std::move(resolved);
}

}  // namespace talus
