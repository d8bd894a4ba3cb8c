#include "scene/loads.hpp"

#include "geometry/box.hpp"
#include "scene/components.hpp"
#include "scene/tables.hpp"
#include "scene/take_function.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string_view>
#include <utility>

namespace talus {
namespace {

void check_moves(Reading& reading, Section& section, std::optional<std::uint32_t> body) {
  if (!body || !reading.scene.bodies[*body].fixed) return;
  reading.mistakes.add(
      section.pointer_to("body"),
      fmt::format("body \"{}\" is fixed: expected one that moves", reading.scene.bodies[*body].name));
}

void check_has_wave_speeds(Reading& reading, Section& section, std::optional<std::uint32_t> body) {
  if (!body) return;
  const SceneBody& taken = reading.scene.bodies[*body];
  if (taken.cover.component == nullptr ||
      std::string_view(taken.cover.component->component->name) != rigid_cover ||
      reading.scene.materials[taken.material].model.component != nullptr)
    return;
  reading.mistakes.add(section.pointer_to("body"),
                       fmt::format("body \"{}\" is rigid: an absorbing surface needs the wave speeds of a "
                                   "material that deforms",
                                   taken.name));
}

/// Twice the impedance reflects a third of a wave.
void check_absorbs_once(Reading& reading, Section& section, const AbsorbingSurface& one) {
  const bool listed = std::ranges::any_of(reading.scene.absorbing, [&](const AbsorbingSurface& other) {
    return other.body == one.body && other.surface_class == one.surface_class;
  });
  if (listed)
    reading.mistakes.add(section.pointer_to("surface"),
                         "the surface is listed already: expected each once, or its dashpots act twice");
}

PrescribedSurface read_one_prescribed(Reading& reading, Section& section) {
  PrescribedSurface one{};
  const auto body = take_body(reading, section);
  check_moves(reading, section, body);
  one.body = body.value_or(0);
  one.surface_class = take_surface(reading, section, body).value_or(0);
  one.stiffness = section.value(table::of(table::prescribed, "stiffness"));
  one.ramp = section.value(table::of(table::prescribed, "ramp"));
  const std::size_t mistakes_before = reading.mistakes.count();
  one.displacement = free_vector_function(reading, section, table::of(table::prescribed, "displacement"));
  one.velocity = free_vector_function(reading, section, table::of(table::prescribed, "velocity"));
  if (!one.holds(0) && !one.holds(1) && reading.mistakes.count() == mistakes_before) {
    reading.mistakes.add(section.pointer(),
                         "nothing is prescribed: expected \"displacement\": [ux, uy] [m] or "
                         "\"velocity\": [vx, vy] [m/s] with a value on one axis at least");
  }
  section.finish();
  return one;
}

/// Which hold the same surface along an axis as one does.
std::vector<const PrescribedSurface*> holders(std::span<const PrescribedSurface> supports,
                                              const PrescribedSurface& like, std::size_t axis) {
  std::vector<const PrescribedSurface*> found;
  for (const PrescribedSurface& one : supports) {
    if (one.body == like.body && one.surface_class == like.surface_class && one.holds(axis))
      found.push_back(&one);
  }
  return found;
}

/// What a support holds besides what its velocities have travelled, at a time.
Function held_at(const PrescribedSurface& support, std::size_t axis, double time) {
  const double share = support.ramp_share(axis, time);
  Function held;
  if (share > 0 && support.displacement[axis]) held = share * support.displacement[axis]->frozen(time);
  return share < 1 ? held + (1 - share) * support.past[axis].former : held;
}

SupportPast past_of(const PrescribedSurface& now, const PrescribedSurface* before, std::size_t axis,
                    double from) {
  const auto travelled = [&](const PrescribedSurface& support) {
    return support.velocity[axis] ? support.velocity[axis]->integrated(from) : Function{};
  };
  if (before == nullptr) return {from, {}, -1 * travelled(now)};
  SupportPast past = before->past[axis];
  const bool same_velocity = now.velocity[axis] == before->velocity[axis];
  if (!same_velocity) past.travelled = past.travelled + travelled(*before) + -1 * travelled(now);
  if (now.displacement[axis] == before->displacement[axis]) {
    if (now.ramp == before->ramp) return past;
    if (before->ramp_share(axis, from) == 1) {  // it is over, whatever it would be now
      past.since = -std::numeric_limits<double>::infinity();
      return past;
    }
  }
  past.since = from;
  past.former = held_at(*before, axis, from);
  // One that goes on by a velocity alone goes on from there; one that is given a displacement alone comes to
  // that, wherever it is.
  if (!now.displacement[axis]) {
    past.travelled = past.travelled + std::exchange(past.former, {});
  } else if (!now.velocity[axis]) {
    past.former = past.former + std::exchange(past.travelled, {});
  }
  return past;
}

/// The ends of the edges of a surface. None in a scene without materials, which has no surfaces either.
std::vector<Vec2> ends_of(const SceneBody& body, std::uint32_t surface_class) {
  std::vector<Vec2> ends;
  each_loop(body, [&](const Loop& loop) {
    for (std::size_t i = 0; i < loop.surface_class.size(); ++i) {
      if (loop.surface_class[i] != surface_class) continue;
      ends.push_back(loop.vertices[i]);
      ends.push_back(loop.vertices[(i + 1) % loop.vertices.size()]);
    }
  });
  return ends;
}

/// Tables over place are in the scene's coordinates: those from a drawing of its own miss the surface.
void warn_of_idle_tables(Reading& reading, const Section& section, const SurfaceLoad& load, const char* key,
                         const Function& function) {
  const SceneBody& body = reading.scene.bodies[load.body];
  const std::vector<Vec2> ends = ends_of(body, load.surface_class);
  if (function.zero() || ends.empty()) return;
  const auto [low, high] = box_around(ends);
  if (!function.zero_within(low, high)) return;
  std::string warning = fmt::format(
      "{}: the tables over place are 0 all along that surface of '{}', which reaches from ({:.6g}, "
      "{:.6g}) to ({:.6g}, {:.6g}) m",
      section.pointer_to(key), body.name, low.x, low.y, high.x, high.y);
  std::vector<std::string>& warnings = reading.scene.warnings;
  if (warnings.empty() || warnings.back() != warning)
    warnings.push_back(std::move(warning));  // once for x, y
}

SurfaceLoad read_surface_load(Reading& reading, Section& section) {
  SurfaceLoad load{};
  const auto body = take_body(reading, section);
  check_moves(reading, section, body);
  load.body = body.value_or(0);
  load.surface_class = take_surface(reading, section, body).value_or(0);
  const bool given = section.has("traction") || section.has("pressure");
  if (section.has("traction"))
    load.traction = vector_function(reading, section, table::of(table::surface_load, "traction"));
  section.child("traction");
  load.pressure =
      optional_function(reading, section, table::of(table::surface_load, "pressure")).value_or(Function{});
  if (!given) {
    reading.mistakes.add(section.pointer(),
                         "nothing acts: expected \"traction\": [tx, ty] [Pa] or \"pressure\" [Pa]");
  }
  if (body) {
    for (const Function& along : load.traction)
      warn_of_idle_tables(reading, section, load, "traction", along);
    warn_of_idle_tables(reading, section, load, "pressure", load.pressure);
  }
  section.finish();
  return load;
}

}  // namespace

void read_loads(Reading& reading, Section& root) {
  OrderedJson resolved = OrderedJson::array();
  root.list("loads", "a list of loads [{\"body\": ..., \"point\": ..., \"force\": ...}]",
            [&](const Json& value, const std::string& pointer) {
              Section section(&value, pointer, reading.mistakes);
              const auto body = take_body(reading, section);
              check_moves(reading, section, body);
              const Vec2 point = take_point(reading, section, body).value_or(Vec2{});
              if (!section.has("point")) section.pair(table::coordinate);
              VectorFunction force = vector_function(reading, section, table::of(table::load, "force"));
              section.finish();
              reading.scene.loads.push_back({body.value_or(0), point, std::move(force)});
              resolved.push_back(section.resolved);
            });
  root.resolved["loads"] = std::move(resolved);
}

void read_surface_loads(Reading& reading, Section& root) {
  OrderedJson resolved = OrderedJson::array();
  root.list("surface_loads",
            "a list of loads [{\"body\": ..., \"surface\": ..., \"traction\": ..., \"pressure\": ...}]",
            [&](const Json& value, const std::string& pointer) {
              Section section(&value, pointer, reading.mistakes);
              reading.scene.surface_loads.push_back(read_surface_load(reading, section));
              resolved.push_back(section.resolved);
            });
  root.resolved["surface_loads"] = std::move(resolved);
}

void read_absorbing(Reading& reading, Section& root) {
  OrderedJson resolved = OrderedJson::array();
  root.list("absorbing", "a list of surfaces that let waves out [{\"body\": ..., \"surface\": ...}]",
            [&](const Json& value, const std::string& pointer) {
              Section section(&value, pointer, reading.mistakes);
              const auto body = take_body(reading, section);
              check_moves(reading, section, body);
              check_has_wave_speeds(reading, section, body);
              const auto surface = take_surface(reading, section, body);
              section.finish();
              if (body && surface) check_absorbs_once(reading, section, {*body, *surface});
              reading.scene.absorbing.push_back({body.value_or(0), surface.value_or(0)});
              resolved.push_back(section.resolved);
            });
  root.resolved["absorbing"] = std::move(resolved);
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

void continue_prescribed(std::vector<PrescribedSurface>& supports, std::span<const PrescribedSurface> before,
                         double from) {
  for (PrescribedSurface& support : supports) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      if (!support.holds(axis)) continue;
      // Where several hold the same, the first goes on from the first.
      const auto now = holders(supports, support, axis), then = holders(before, support, axis);
      const auto number = static_cast<std::size_t>(std::ranges::find(now, &support) - now.begin());
      support.past[axis] = past_of(support, number < then.size() ? then[number] : nullptr, axis, from);
    }
  }
}

}  // namespace talus
