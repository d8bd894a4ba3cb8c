#include "scene/interfaces.hpp"

#include "plugin/parameters.hpp"
#include "scene/surfaces.hpp"
#include "scene/tables.hpp"
#include "text/nearest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>
#include <string_view>
#include <utility>

namespace talus {
namespace {

/// One side of "between".
struct Side {
  enum class Kind { anything, material, surface, surface_of_body } kind = Kind::anything;
  std::string name, body;
};

struct Row {
  std::size_t number;  ///< in the scene's list
  std::array<Side, 2> between;
};

const Json* sides_of(const Json& row) {
  if (!row.is_object()) return nullptr;
  const auto between = row.find("between");
  return between != row.end() && between->is_array() && between->size() == 2 ? &*between : nullptr;
}

/// All "body/surface" of the table: such surfaces are classes of their own.
std::set<std::string> surfaces_of_single_bodies(const Json* rows) {
  std::set<std::string> single;
  if (rows == nullptr || !rows->is_array()) return single;
  for (const Json& row : *rows) {
    const Json* between = sides_of(row);
    if (between == nullptr) continue;
    for (const Json& side : *between) {
      if (side.is_string() && side.get<std::string>().find('/') != std::string::npos) single.insert(side);
    }
  }
  return single;
}

/// What can stand in "between".
struct Names {
  std::set<std::string> surfaces, of_bodies;
  std::vector<std::string> all{"*"};

  explicit Names(const Reading& reading) {
    for (std::size_t i = 0; i < reading.surface_names.size(); ++i) {
      for (const std::string& surface : reading.surface_names[i].all()) {
        surfaces.insert(surface);
        of_bodies.insert(reading.scene.bodies[i].name + '/' + surface);
      }
    }
    for (const auto& [name, index] : reading.material_index) all.push_back(name);
    all.insert(all.end(), surfaces.begin(), surfaces.end());
  }
};

std::optional<Side> read_side(const Reading& reading, const Names& names, const Json& value,
                              const std::string& pointer) {
  if (!value.is_string()) {
    reading.mistakes.add(
        pointer, fmt::format("{} is not allowed here: expected the name of a material or surface, or \"*\"",
                             shown(value)));
    return std::nullopt;
  }
  const std::string name = value.get<std::string>();
  if (name == "*") return Side{};
  if (reading.material_index.contains(name)) return Side{Side::Kind::material, name, {}};
  if (names.surfaces.contains(name)) return Side{Side::Kind::surface, name, {}};
  const std::size_t slash = name.find('/');
  if (names.of_bodies.contains(name)) {
    return Side{Side::Kind::surface_of_body, name.substr(slash + 1), name.substr(0, slash)};
  }
  if (!reading.unmade.empty()) return std::nullopt;  // it may be one of blocks that were not made
  if (reading.mistakes.many()) {
    reading.mistakes.add(pointer, fmt::format("there is no material or surface \"{}\"", clipped(name)));
    return std::nullopt;
  }
  std::vector<std::string> candidates = names.all;
  if (slash != std::string::npos) candidates.assign(names.of_bodies.begin(), names.of_bodies.end());
  reading.mistakes.add(pointer,
                       fmt::format("there is no material or surface \"{}\";{} known: {}", clipped(name),
                                   did_you_mean(name, candidates), listed(candidates)));
  return std::nullopt;
}

std::optional<std::array<Side, 2>> read_between(Reading& reading, const Names& names, Section& section) {
  const std::string what = "two of material, surface, body/surface and \"*\"";
  const Json* written = section.required_child("between", what);
  if (written == nullptr) return std::nullopt;
  section.resolved["between"] = *written;
  const std::string pointer = section.pointer_to("between");
  if (!written->is_array() || written->size() != 2) {
    reading.mistakes.add(pointer,
                         fmt::format("{} is not allowed here: expected a list of {}", shown(*written), what));
    return std::nullopt;
  }
  const auto first = read_side(reading, names, (*written)[0], below(pointer, 0));
  const auto second = read_side(reading, names, (*written)[1], below(pointer, 1));
  if (!first || !second) return std::nullopt;
  return std::array{*first, *second};
}

/// Whether a reviewer would ask why it is there when the law does not read it.
bool matters(std::string_view key) {
  return key == "cohesion" || key == "tensile_strength" || key == "friction_angle" ||
         key.starts_with("tangential_") || key == "normal_damping";
}

/// Keys that the chosen law does not read: those of the vocabulary, and of other laws the scene may be varied
/// over.
void read_rest(Section& section, const ContactSection& contact, std::set<std::string>& unread) {
  std::vector<std::span<const Parameter>> tables;
  for (const Component* law : contact.other_laws) {
    tables.emplace_back(law->interface_parameters, law->interface_parameter_count);
  }
  tables.emplace_back(table::interface);
  for (const auto parameters : tables) {
    for (const Parameter& parameter : parameters) {
      if (section.knows(parameter.key)) continue;
      const auto value = section.optional_value(parameter);
      if (value && *value != 0 && matters(parameter.key)) unread.insert(parameter.key);
    }
  }
}

/// Without a known law nothing is required, and whatever any law reads is allowed: laws may give one key
/// different ranges, so that only those of the vocabulary hold.
void read_without_law(const Registry& registry, Section& section) {
  for (const Parameter& parameter : table::interface) section.optional_value(parameter);
  for (const RegisteredComponent& entry : registry.components()) {
    if (entry.component->kind != ComponentKind::contact_model) continue;
    for (const Parameter& parameter :
         std::span(entry.component->interface_parameters, entry.component->interface_parameter_count)) {
      section.child(parameter.key);
    }
  }
}

/// Keys that another installed law reads: they may stand here where the scene names that law.
void tell_of_other_laws(Registry& registry, Section& section) {
  for (const std::string& key : section.keys()) {
    if (section.knows(key)) continue;
    load_offered(registry);
    for (const RegisteredComponent& entry : registry.components()) {
      const Component& law = *entry.component;
      const std::span parameters(law.interface_parameters, law.interface_parameter_count);
      if (law.kind != ComponentKind::contact_model ||
          std::ranges::none_of(parameters, [&](const Parameter& each) { return key == each.key; }))
        continue;
      section.mistakes().add_at_key(
          section.pointer_to(key),
          fmt::format("the chosen law does not read this; '{0}' does: where the scene is to run with either, "
                      "name that in /contact, too: \"{0}\": {{}}",
                      law.name));
      section.child(key);
      break;
    }
  }
}

std::vector<double> read_values(const Reading& reading, Section& section, const ContactSection& contact,
                                std::set<std::string>& unread) {
  std::vector<double> values;
  if (contact.law.component != nullptr) {
    const Component& law = *contact.law.component->component;
    values = section.values(std::span(law.interface_parameters, law.interface_parameter_count));
    read_rest(section, contact, unread);
    tell_of_other_laws(reading.registry, section);
  } else {
    read_without_law(reading.registry, section);
  }
  section.finish();
  return values;
}

bool matches(const Side& side, const NumberedSurface& surface) {
  switch (side.kind) {
    case Side::Kind::anything:
      return true;
    case Side::Kind::material:
      return side.name == surface.material;
    case Side::Kind::surface:
      return side.name == surface.surface;
    case Side::Kind::surface_of_body:
      return side.name == surface.surface && side.body == surface.body;
  }
  return false;
}

/// Two surfaces before a surface and a material before two materials before anything with "*".
int rank(const Row& row) {
  constexpr int specific[] = {0, 2, 4, 5};
  int sum = 0, named = 0;
  for (const Side& side : row.between) {
    sum += specific[static_cast<int>(side.kind)];
    if (side.kind != Side::Kind::anything) ++named;
  }
  return 100 * named + sum;
}

bool covers(const Row& row, const NumberedSurface& a, const NumberedSurface& b) {
  return (matches(row.between[0], a) && matches(row.between[1], b)) ||
         (matches(row.between[0], b) && matches(row.between[1], a));
}

std::string name_of(const NumberedSurface& surface) {
  if (surface.surface.empty()) return fmt::format("\"{}\"", surface.material);
  const std::string of = surface.body.empty() ? surface.surface : surface.body + '/' + surface.surface;
  return fmt::format("\"{}\" of \"{}\"", of, surface.material);
}

/// Rows of the highest rank that cover a pair, at most two.
std::vector<const Row*> best_rows(const std::vector<Row>& rows, const NumberedSurface& a,
                                  const NumberedSurface& b) {
  std::vector<const Row*> best;
  for (const Row& row : rows) {
    if (!covers(row, a, b)) continue;
    if (!best.empty() && rank(row) < rank(*best[0])) continue;
    if (!best.empty() && rank(row) > rank(*best[0])) best.clear();
    if (best.size() < 2) best.push_back(&row);
  }
  return best;
}

/// Of a row that holds for no two surfaces that can meet. One for all that is left may be idle.
void warn_of_idle(Reading& reading, const Row& row, const std::set<std::size_t>& applied) {
  const auto any = [](const Side& side) { return side.kind == Side::Kind::anything; };
  if (applied.contains(row.number) || std::ranges::all_of(row.between, any)) return;
  reading.scene.warnings.push_back(
      fmt::format("/interfaces/{} never applies: none of its surfaces can meet, or more specific rows hold "
                  "for those that can",
                  row.number));
}

/// Fills Scene::interface_row. `complete` tells whether all rows could be read, so that one may be missed.
void resolve(Reading& reading, const std::vector<Row>& rows, const std::vector<NumberedSurface>& surfaces,
             bool complete) {
  const std::size_t count = surfaces.size();
  const std::vector<bool> meet = meetings(reading.scene), may_meet = meetings(reading.scene, true);
  reading.scene.interface_row.assign(count * count, 0);
  std::set<std::pair<std::size_t, std::size_t>> tied;
  std::set<std::size_t> applied;
  std::size_t missing = 0;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i; j < count; ++j) {
      const std::vector<const Row*> best = best_rows(rows, surfaces[i], surfaces[j]);
      const auto row = best.empty() ? 0u : static_cast<std::uint32_t>(best[0]->number);
      reading.scene.interface_row[i * count + j] = reading.scene.interface_row[j * count + i] = row;
      if (may_meet[i * count + j] && !best.empty()) applied.insert(best[0]->number);
      if (may_meet[i * count + j] && best.empty()) reading.scene.without_interface.emplace_back(i, j);
      if (!meet[i * count + j]) continue;
      if (best.empty() && complete && ++missing <= 20) {
        reading.mistakes.add("/interfaces",
                             fmt::format("no row covers {} against {}, which can meet: add a row "
                                         "between the two, or one between \"*\" and \"*\"",
                                         name_of(surfaces[i]), name_of(surfaces[j])));
      }
      if (best.size() == 2 && tied.emplace(best[0]->number, best[1]->number).second) {
        reading.mistakes.add(
            below(below("/interfaces", best[1]->number), "between"),
            fmt::format("covers {} against {} just as /interfaces/{} does: of two rows for a pair one "
                        "must be more specific",
                        name_of(surfaces[i]), name_of(surfaces[j]), best[0]->number));
      }
    }
  }
  for (const Row& row : rows) warn_of_idle(reading, row, applied);
}

void warn(Reading& reading, const ContactSection& contact, const std::set<std::string>& unread) {
  if (contact.law.component == nullptr) return;
  for (const std::string& key : unread) {
    reading.scene.warnings.push_back(
        fmt::format("/interfaces: {} reads no {}", contact.law.component->component->name, key));
  }
}

/// Mohr and Coulomb's line ends at cohesion over tan φ; what laws make of a tensile strength beyond it
/// differs.
void warn_of_strength(Reading& reading, const Component& law) {
  const std::span<const Parameter> parameters(law.interface_parameters, law.interface_parameter_count);
  const auto angle = index_of(parameters, "friction_angle"), cohesion = index_of(parameters, "cohesion"),
             tensile = index_of(parameters, "tensile_strength");
  if (!angle || !cohesion || !tensile) return;
  constexpr double rounding = 1e-9;
  for (std::size_t row = 0; row < reading.scene.interface_values.size(); ++row) {
    const std::vector<double>& values = reading.scene.interface_values[row];
    if (values.size() != parameters.size() ||
        !(values[*tensile] * std::tan(values[*angle]) > values[*cohesion] * (1 + rounding)))
      continue;
    reading.scene.warnings.push_back(fmt::format(
        "/interfaces/{}: a tensile strength of {:.4g} Pa is above cohesion/tan(friction angle), {:.4g} Pa, "
        "where the line of Mohr and Coulomb ends: a law may bear no more than that (cohesive_overlap) or "
        "all of it (vertex_edge)",
        row, values[*tensile], values[*cohesion] / std::tan(values[*angle])));
  }
}

}  // namespace

void read_interfaces(Reading& reading, Section& root, const ContactSection& contact) {
  const Json* written = root.child("interfaces");
  const std::vector<NumberedSurface> surfaces = number_surfaces(reading, surfaces_of_single_bodies(written));
  const Names names(reading);
  std::vector<Row> rows;
  std::set<std::string> unread;
  std::size_t number = 0;
  OrderedJson resolved = OrderedJson::array();
  const std::string what = "a list of rows [{\"between\": [..., ...], ...}]";
  const std::size_t mistakes_before = reading.mistakes.count();
  root.list("interfaces", what, [&](const Json& value, const std::string& pointer) {
    Section section(&value, pointer, reading.mistakes);
    if (const auto between = read_between(reading, names, section)) rows.push_back({number, *between});
    reading.scene.interface_values.push_back(read_values(reading, section, contact, unread));
    resolved.push_back(section.resolved);
    ++number;
  });
  if (written != nullptr) root.resolved["interfaces"] = std::move(resolved);
  warn(reading, contact, unread);
  if (contact.law.component != nullptr) warn_of_strength(reading, *contact.law.component->component);
  const std::vector<bool> meet = meetings(reading.scene);
  if (std::find(meet.begin(), meet.end(), true) == meet.end()) {
    reading.scene.interface_row.assign(meet.size(), 0);
    return;
  }
  if (!contact.given) root.required_child("contact", "{\"model\": ...}, the law by which bodies meet");
  if (written == nullptr) {
    root.required_child("interfaces", what);
    return;
  }
  resolve(reading, rows, surfaces, reading.mistakes.count() == mistakes_before);
  reading.scene.contact = contact.law;
}

}  // namespace talus
