#include "scene/joints.hpp"

#include "blocks/dxf.hpp"
#include "scene/discontinuities.hpp"
#include "scene/files.hpp"
#include "scene/reading.hpp"
#include "scene/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace talus {
namespace {

/// A number that must be whole.
double take_whole(Section& section, const Parameter& parameter) {
  const double taken = section.value(parameter);
  if (!std::isnan(taken) && taken != std::floor(taken)) {
    section.mistakes().add(section.pointer_to(parameter.key),
                           fmt::format("{} is not allowed here: expected a whole number", taken));
  }
  return taken;
}

std::uint64_t take_seed(Section& section, const Parameter& parameter) {
  const double seed = take_whole(section, parameter);
  return std::isnan(seed) ? 0 : static_cast<std::uint64_t>(seed);
}

void check_gap(Section& section, double persistence) {
  const bool has_gap = section.has("gap");
  if (persistence < 1 && !has_gap) {
    section.mistakes().add(
        section.pointer(),
        fmt::format("\"persistence\" {} leaves bridges: \"gap\" must say how long they are [m]",
                    persistence));
  }
  if (persistence == 1 && has_gap) {
    section.mistakes().add_at_key(
        section.pointer_to("gap"),
        "\"persistence\" 1 leaves no bridges: give one below 1, or leave \"gap\" out");
  }
}

void read_joint_set(Section& section, Joints& joints) {
  using table::joint_set, table::of;
  JointSet set{};
  set.dip = section.value(of(joint_set, "dip"));
  set.spacing = section.value(of(joint_set, "spacing"));
  set.offset = section.value(of(joint_set, "offset"));
  set.jitter = section.value(of(joint_set, "jitter"));
  set.persistence = section.value(of(joint_set, "persistence"));
  set.gap = section.optional_value(of(joint_set, "gap")).value_or(0);
  set.seed = take_seed(section, of(joint_set, "seed"));
  const std::string surface = read_line_surface(section);
  joints.naming_keys.push_back({surface, section.pointer_to("surface"), {}});
  set.surface = joints.number_of(surface);
  check_gap(section, set.persistence);
  section.finish();
  joints.sets.push_back(set);
}

void read_bricks(Section& section, Joints& joints) {
  using table::bricks, table::of;
  joints.bricks = Bricks{section.value(of(bricks, "width")), section.value(of(bricks, "height")),
                         section.value(of(bricks, "gap")), section.value(of(bricks, "bond")) == 0};
  section.finish();
}

void read_voronoi(Section& section, Joints& joints) {
  using table::voronoi, table::of;
  Sites sites{};
  const bool by_count = section.has("count"), by_spacing = section.has("spacing");
  if (by_count == by_spacing) {
    section.mistakes().add(section.pointer(), by_count
                                                  ? "\"count\" and \"spacing\" are given: keep one of the two"
                                                  : "required key \"count\" or \"spacing\" is missing");
  }
  if (by_count) sites.count = take_whole(section, of(voronoi, "count"));
  sites.spacing = section.optional_value(of(voronoi, "spacing")).value_or(0);
  section.child("count");
  if (by_count && section.has("jitter")) {
    section.mistakes().add_at_key(
        section.pointer_to("jitter"),
        "points by \"count\" lie at random already: \"jitter\" goes with \"spacing\"");
  }
  sites.jitter = section.value(of(voronoi, "jitter"));
  sites.seed = take_seed(section, of(voronoi, "seed"));
  section.finish();
  joints.sites = sites;
}

/// Of $INSUNITS, what is not the metres that a drawing is read in.
constexpr std::pair<int, std::string_view> foreign_units[] = {{1, "inches"},
                                                              {2, "feet"},
                                                              {3, "miles"},
                                                              {4, "millimetres"},
                                                              {5, "centimetres"},
                                                              {7, "kilometres"},
                                                              {8, "microinches"},
                                                              {9, "mils"},
                                                              {10, "yards"},
                                                              {11, "angstroms"},
                                                              {12, "nanometres"},
                                                              {13, "micrometres"},
                                                              {14, "decimetres"},
                                                              {15, "decametres"},
                                                              {16, "hectometres"},
                                                              {17, "gigametres"},
                                                              {18, "astronomical units"},
                                                              {19, "light years"},
                                                              {20, "parsecs"},
                                                              {21, "US survey feet"},
                                                              {22, "US survey inches"},
                                                              {23, "US survey yards"},
                                                              {24, "US survey miles"}};

/// CAD does not tell large letters from small ones.
bool same_layer(std::string_view p, std::string_view q) {
  return std::ranges::equal(
      p, q, [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); });
}

void take_drawing(const DxfDrawing& drawing, const std::string& file, Section& section, Joints& joints) {
  const std::string pointer = section.pointer_to("dxf");
  joints.drawing = file;
  joints.first_of_drawing = joints.cuts.size();
  std::set<std::string> layers;
  for (const DxfLine& line : drawing.lines) {
    if (line.layer != "0" && layers.insert(line.layer).second &&
        check_name(line.layer, pointer, section.mistakes()))
      joints.naming_keys.push_back({line.layer, pointer, file});
    for (const Vec2 point : line.points) {
      if (std::max(std::abs(point.x), std::abs(point.y)) <= table::largest_coordinate) continue;
      section.mistakes().add(
          pointer, fmt::format("{}: point ({}, {}) is out of range: expected coordinates up to {} m", file,
                               point.x, point.y, table::largest_coordinate));
      return;
    }
    joints.cuts.push_back({line.points, joints.number_of(line.layer == "0" ? "" : line.layer), true});
  }
  for (const std::string& layer : drawing.hidden_layers) {
    if (std::ranges::any_of(drawing.lines,
                            [&](const DxfLine& line) { return same_layer(line.layer, layer); }))
      joints.warnings.push_back(
          fmt::format("{}: layer '{}' is switched off or frozen there, and its lines are joints all the same",
                      file, layer));
  }
  for (const auto& [kind, count] : drawing.passed_over)
    joints.warnings.push_back(fmt::format("{}: {} of the kind {} passed over", file, count, kind));
  for (const auto& [kind, count] : drawing.flattened)
    joints.warnings.push_back(fmt::format(
        "{}: {} of the kind {} not level (z varies): taken as seen from above", file, count, kind));
  for (const auto& [number, name] : foreign_units) {
    if (number == drawing.units)
      joints.warnings.push_back(
          fmt::format("{}: drawn in {} ($INSUNITS {}), read as metres", file, name, number));
  }
}

void read_drawing(Section& section, const std::filesystem::path& folder, Joints& joints) {
  const std::string written = section.text("dxf", "the path of a drawing \"file.dxf\"");
  const std::string pointer = section.pointer_to("dxf");
  if (written.empty()) {
    if (section.resolved["dxf"] == written) section.mistakes().add(pointer, "\"\" is no path of a drawing");
    return;
  }
  const std::filesystem::path file = folder / written;
  if (!is_file(file)) {
    section.mistakes().add(pointer, fmt::format("there is no file {}", file.string()));
    return;
  }
  try {
    take_drawing(read_dxf(file), file.string(), section, joints);
    note_file(joints.files, file);
  } catch (const std::runtime_error& failure) {  // InputError or std::system_error
    section.mistakes().add(pointer, failure.what());
  }
}

}  // namespace

std::uint32_t Joints::number_of(const std::string& surface) {
  const auto number = std::find(surfaces.begin(), surfaces.end(), surface) - surfaces.begin();
  if (static_cast<std::size_t>(number) == surfaces.size()) surfaces.push_back(surface);
  return static_cast<std::uint32_t>(number);
}

Joints read_joints(Section& generator, const std::filesystem::path& folder) {
  Joints joints;
  Mistakes& mistakes = generator.mistakes();
  generator.list("joint_sets", "a list of joint sets [{\"dip\": ..., \"spacing\": ...}]",
                 [&](const Json& value, const std::string& pointer) {
                   Section section(&value, pointer, mistakes);
                   read_joint_set(section, joints);
                 });
  std::vector<std::string> surfaces;
  const std::vector<Discontinuity> lines = read_polylines(generator, "joints", surfaces);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    joints.naming_keys.push_back({surfaces[i], below(generator.pointer_to("joints"), i) + "/surface", {}});
    joints.cuts.push_back({lines[i].points, joints.number_of(surfaces[i]), true});
  }
  if (const Json* written = generator.child("bricks")) {
    Section section(written, generator.pointer_to("bricks"), mistakes);
    read_bricks(section, joints);
  }
  if (const Json* written = generator.child("voronoi")) {
    Section section(written, generator.pointer_to("voronoi"), mistakes);
    read_voronoi(section, joints);
  }
  if (const Json* written = generator.child("split")) {
    Section section(written, generator.pointer_to("split"), mistakes);
    joints.split_share = section.value(table::of(table::split, "share"));
    joints.split_seed = take_seed(section, table::of(table::split, "seed"));
    section.finish();
  }
  if (generator.child("dxf") != nullptr) read_drawing(generator, folder, joints);
  return joints;
}

}  // namespace talus
