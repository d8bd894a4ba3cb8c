#include "scene/reading.hpp"

#include "geometry/outlines.hpp"
#include "scene/tables.hpp"
#include "text/nearest.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace talus {

std::set<std::string> SurfaceNames::all() const {
  std::set<std::string> names(discontinuities.begin(), discontinuities.end());
  for (const std::vector<std::string>& loop : edges) names.insert(loop.begin(), loop.end());
  names.erase("");
  return names;
}

namespace {

constexpr std::size_t longest_name = 200;  // it stands in every message and column about what it names

}  // namespace

bool check_name(const std::string& name, const std::string& pointer, Mistakes& mistakes) {
  bool good = !name.empty() && name.front() != ' ' && name.back() != ' ' && name != "*" &&
              name.size() <= longest_name;
  for (const char c : name) {
    if (std::string_view("/,.\"").find(c) != std::string_view::npos || static_cast<unsigned char>(c) < 0x20)
      good = false;
  }
  if (!good) {
    mistakes.add(
        pointer,
        fmt::format("{} is no name: expected text of up to {} bytes without / , . \", or blanks at its ends, "
                    "and other than \"*\"",
                    shown(Json(name)), longest_name));
  }
  return good;
}

std::optional<std::string> take_name(Section& section, const std::string& what) {
  const std::size_t mistakes_before = section.mistakes().count();
  std::string name = section.text("name", what);
  if (section.mistakes().count() != mistakes_before) return std::nullopt;
  check_name(name, section.pointer_to("name"), section.mistakes());
  return name;
}

std::optional<std::uint32_t> take_reference(Section& section, const std::string& key, const std::string& what,
                                            const std::map<std::string, std::uint32_t>& index) {
  const std::size_t mistakes_before = section.mistakes().count();
  const std::string name = section.text(key, fmt::format("the name of a {}", what));
  if (const auto found = index.find(name); found != index.end()) return found->second;
  if (section.has(key) && section.mistakes().count() == mistakes_before) {
    std::vector<std::string> names;
    if (!section.mistakes().many()) {
      for (const auto& [known, position] : index) names.push_back(known);
    }
    const std::string help = names.empty() && !index.empty()
                                 ? std::string()
                                 : fmt::format(";{} known: {}", did_you_mean(name, names), listed(names));
    section.mistakes().add(section.pointer_to(key),
                           fmt::format("there is no {} \"{}\"{}", what, clipped(name), help));
  }
  return std::nullopt;
}

std::optional<std::uint32_t> take_body(const Reading& reading, Section& section) {
  if (const Json* written = section.child("body"); written != nullptr && written->is_string()) {
    const std::string name = written->get<std::string>();
    const bool unmade =
        std::any_of(reading.unmade.begin(), reading.unmade.end(),
                    [&](const std::string& prefix) { return name.starts_with(prefix + '_'); });
    if (unmade && !reading.body_index.contains(name)) return std::nullopt;
  }
  return take_reference(section, "body", "body", reading.body_index);
}

std::optional<std::uint32_t> take_surface(Reading& reading, Section& section,
                                          std::optional<std::uint32_t> body) {
  const std::string surface = section.text("surface", "the name of a surface of the body");
  if (!body || surface.empty()) return std::nullopt;
  const std::set<std::string> known = reading.surface_names[*body].all();
  if (!known.contains(surface)) {
    const std::vector<std::string> list(known.begin(), known.end());
    reading.mistakes.add(
        section.pointer_to("surface"),
        fmt::format("body \"{}\" has no surface \"{}\";{} it has: {}", reading.scene.bodies[*body].name,
                    clipped(surface), did_you_mean(surface, list), listed(list)));
    return std::nullopt;
  }
  // Not numbered where there is no material.
  const auto& classes = reading.surface_class[*body];
  const auto found = classes.find(surface);
  return found != classes.end() ? std::optional(found->second) : std::nullopt;
}

std::optional<Vec2> take_point(const Reading& reading, Section& section, std::optional<std::uint32_t> body) {
  const std::optional<Vec2> point = section.optional_pair(table::coordinate);
  if (!point || !body || !reading.sound[*body]) return point;
  const SceneBody& of = reading.scene.bodies[*body];
  const Loops loops = loops_of(of);
  if (!contains(loops, *point, 1e-6 * extent(loops))) {
    section.mistakes().add(
        section.pointer_to("point"),
        fmt::format("({}, {}) is no point of body \"{}\": expected one within it or on its boundary",
                    point->x, point->y, of.name));
  }
  return point;
}

}  // namespace talus
