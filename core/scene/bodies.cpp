#include "scene/bodies.hpp"

#include "scene/components.hpp"
#include "scene/discontinuities.hpp"
#include "scene/loops.hpp"
#include "scene/tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <utility>

namespace talus {
namespace {

Choice read_cover(Reading& reading, Section& section, OrderedJson& resolved) {
  const std::size_t mistakes_before = reading.mistakes.count();
  const std::string model = section.text("model", "the name of a cover", default_cover);
  Choice cover;
  if (reading.mistakes.count() == mistakes_before) {
    cover = read_choice(reading, section, ComponentKind::cover_builder, model);
  } else {
    accept_all(section);
  }
  section.finish();
  if (cover.component != nullptr && reading.mistakes.count() == mistakes_before)
    check_constructor(reading, cover, section.pointer());
  resolved["cover"] = section.resolved;
  return cover;
}

/// Whether a body needs the scene's cover: it moves and has none of its own.
bool cover_is_needed(const Json* bodies) {
  if (bodies == nullptr || !bodies->is_array()) return false;
  for (const Json& body : *bodies) {
    if (!body.is_object()) continue;
    const auto fixed = body.find("fixed");
    const bool moves = fixed == body.end() || *fixed != true;
    if (moves && !body.contains("cover")) return true;
  }
  return false;
}

/// "fix" and "drive".
Support read_support(Reading& reading, Section& body) {
  Support support;
  const auto axis = [&](std::string_view name) -> std::optional<double>& {
    return name == "x" ? support.x : name == "y" ? support.y : support.rotation;
  };
  const Parameter which = choice("fix", "x|y|rotation", 0, "");
  const std::string what = "a list of \"x\", \"y\" and \"rotation\"";
  body.list("fix", what, [&](const Json& entry, const std::string& pointer) {
    if (std::isnan(take_value(which, entry, pointer, reading.mistakes))) return;
    std::optional<double>& held = axis(entry.get<std::string>());
    if (held)
      reading.mistakes.add(pointer, fmt::format("{} stands twice in the list: once is enough", shown(entry)));
    held = 0;
  });
  if (const Json* fix = body.child("fix")) body.resolved["fix"] = *fix;
  if (const Json* written = body.child("drive")) {
    Section drive(written, body.pointer_to("drive"), reading.mistakes);
    for (const Parameter& parameter : table::drive) {
      const auto velocity = drive.optional_value(parameter);
      if (!velocity) continue;
      std::optional<double>& held = axis(parameter.key);
      if (held) {
        reading.mistakes.add(
            drive.pointer_to(parameter.key),
            fmt::format("\"{}\" is fixed and driven at once: keep it in \"fix\" or in \"drive\"",
                        parameter.key));
      }
      held = *velocity;
    }
    drive.finish();
    body.resolved["drive"] = drive.resolved;
  }
  return support;
}

/// A body without unknowns is neither held nor cut.
void check_fixed(Section& section, const SceneBody& body) {
  if (!body.fixed) return;
  for (const char* key : {"fix", "drive", "discontinuities", "self_contact"}) {
    const Json* given = section.child(key);
    const bool asks_for_nothing =
        given != nullptr && (*given == false || (given->is_structured() && given->empty()));
    if (given == nullptr || asks_for_nothing) continue;
    section.mistakes().add_at_key(
        section.pointer_to(key),
        fmt::format("the body is \"fixed\", which leaves nothing for \"{}\": keep one of the two", key));
  }
}

/// Initial velocities must not contradict what holds the body.
void check_start(Section& section, const SceneBody& body) {
  const auto contradicts = [&](double given, const std::optional<double>& held) {
    return given != 0 && !std::isnan(given) && (body.fixed || (held && *held != given));
  };
  const auto tell = [&](const char* key) {
    section.mistakes().add(
        section.pointer_to(key),
        fmt::format("{} contradicts what holds the body: {}", shown(Json(section.resolved[key])),
                    body.fixed ? "a \"fixed\" body stays at rest"
                               : "\"fix\" or \"drive\" prescribes another velocity"));
  };
  if (contradicts(body.velocity.x, body.support.x) || contradicts(body.velocity.y, body.support.y))
    tell("velocity");
  if (contradicts(body.angular_velocity, body.support.rotation)) tell("angular_velocity");
}

void check_model(Reading& reading, Section& section, const SceneBody& body) {
  if (body.fixed || reading.material_has_model[body.material]) return;
  if (body.cover.component != nullptr &&
      std::string_view(body.cover.component->component->name) == rigid_cover)
    return;
  const std::string& material = reading.scene.materials[body.material].name;
  reading.mistakes.add(
      section.pointer_to("material"),
      fmt::format("material \"{}\" has no \"model\", but a body that deforms needs one: give it a "
                  "model, or the body \"fixed\": true or \"cover\": {{\"model\": \"rigid\"}}",
                  material));
}

void read_geometry(Reading& reading, Section& section, SceneBody& body) {
  Shape shape = read_shape(reading, section);
  body.outer.vertices = std::move(shape.loops[0]);
  for (std::size_t i = 1; i < shape.loops.size(); ++i) body.holes.push_back({std::move(shape.loops[i]), {}});
  body.mesh = std::move(shape.mesh);
  reading.sound.push_back(shape.sound);
  SurfaceNames& names = reading.surface_names.emplace_back();
  names.edges = std::move(shape.edge_surface);
  body.discontinuities = read_discontinuities(section, names.discontinuities);
  body.self_contact = section.value(table::of(table::body, "self_contact")) == 1;
}

SceneBody read_body(Reading& reading, Section& section, const Choice& scene_cover, bool scene_cover_good) {
  SceneBody body{};
  Mistakes& mistakes = reading.mistakes;
  if (const auto name = take_name(section, "the name of the body")) {
    body.name = *name;
    const auto number = static_cast<std::uint32_t>(reading.scene.bodies.size());
    const auto [known, is_new] = reading.body_index.emplace(body.name, number);
    if (!is_new) {
      mistakes.add(section.pointer_to("name"),
                   fmt::format("\"{}\" is the name of /bodies/{} already: names must differ", body.name,
                               known->second));
    }
  }
  read_geometry(reading, section, body);
  const auto material = take_reference(section, "material", "material", reading.material_index);
  body.material = material.value_or(0);
  body.fixed = section.value(table::of(table::body, "fixed")) == 1;
  bool cover_good = true;
  if (const Json* written = section.child("cover")) {
    Section cover(written, section.pointer_to("cover"), mistakes);
    body.cover = read_cover(reading, cover, section.resolved);
    cover_good = body.cover.component != nullptr;
  } else if (!body.fixed) {
    body.cover = scene_cover;
    cover_good = scene_cover_good;
  }
  if (material && cover_good) check_model(reading, section, body);
  if (body.fixed) body.cover = {};
  body.support = read_support(reading, section);
  body.velocity = section.pair(table::of(table::body, "velocity"));
  body.angular_velocity = section.value(table::of(table::body, "angular_velocity"));
  body.priority = section.value(table::of(table::body, "priority"));
  check_fixed(section, body);
  check_start(section, body);
  section.finish();
  return body;
}

void report_overlaps(Reading& reading) {
  const std::vector<SceneBody>& bodies = reading.scene.bodies;
  std::vector<Loops> shapes;
  std::vector<std::size_t> number;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!reading.sound[i]) continue;
    number.push_back(i);
    shapes.push_back(loops_of(bodies[i]));
  }
  std::vector<const Loops*> pointers;
  for (const Loops& loops : shapes) pointers.push_back(&loops);
  const std::vector<BodyOverlap> overlaps = overlapping_bodies(pointers);
  constexpr std::size_t enough = 20;  // a scene in wrong units overlaps everywhere
  for (std::size_t i = 0; i < overlaps.size(); ++i) {
    const std::size_t a = number[overlaps[i].a], b = number[overlaps[i].b];
    const bool last = i + 1 == enough && overlaps.size() > enough;
    reading.mistakes.add(
        below(below("/bodies", b), bodies[b].mesh.corners.empty() ? "polygon" : "mesh"),
        fmt::format("bodies \"{}\" and \"{}\" overlap at the start by {:.4g} m2: they may touch, no more{}",
                    bodies[a].name, bodies[b].name, overlaps[i].area,
                    last ? fmt::format(" (and {} more pairs)", overlaps.size() - enough) : ""));
    if (last) return;
  }
}

/// A model counts where a deformable body uses it; elsewhere it was checked and is not needed.
void drop_unused_models(Reading& reading) {
  std::vector<bool> used(reading.scene.materials.size(), false);
  for (const SceneBody& body : reading.scene.bodies) {
    const RegisteredComponent* cover = body.cover.component;
    if (cover != nullptr && std::string_view(cover->component->name) != rigid_cover && !used.empty())
      used[body.material] = true;
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) reading.scene.materials[i].model = {};
  }
}

}  // namespace

void read_bodies(Reading& reading, Section& root) {
  const std::string what = "a list of bodies [{\"name\": ..., \"polygon\": ..., \"material\": ...}]";
  const Json* bodies = root.required_child("bodies", what);
  Choice scene_cover;
  if (const Json* written = root.child("cover"); written != nullptr || cover_is_needed(bodies)) {
    Section section(written, root.pointer_to("cover"), reading.mistakes);
    scene_cover = read_cover(reading, section, root.resolved);
  }
  if (bodies == nullptr) return;
  OrderedJson resolved = OrderedJson::array();
  root.list("bodies", what, [&](const Json& value, const std::string& pointer) {
    Section section(&value, pointer, reading.mistakes);
    reading.scene.bodies.push_back(
        read_body(reading, section, scene_cover, scene_cover.component != nullptr));
    resolved.push_back(section.resolved);
  });
  if (bodies->is_array() && bodies->empty() && reading.unmade.empty())
    reading.mistakes.add("/bodies", fmt::format("[] holds no body: expected {}", what));
  root.resolved["bodies"] = std::move(resolved);
  report_overlaps(reading);
  drop_unused_models(reading);
}

}  // namespace talus
