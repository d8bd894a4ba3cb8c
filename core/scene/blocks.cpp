#include "scene/blocks.hpp"

#include "blocks/cut.hpp"
#include "geometry/place.hpp"
#include "scene/joints.hpp"
#include "scene/loops.hpp"
#include "scene/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

namespace talus {
namespace {

/// Keys of bodies that all blocks of a generator have in common.
constexpr const char* shared_keys[] = {"material", "cover", "fixed",    "velocity",    "angular_velocity",
                                       "fix",      "drive", "priority", "self_contact"};

constexpr const char* generators_expected =
    "a list of generators [{\"name\": ..., \"domain\": [[x, y], ...], \"joint_sets\": [...], \"material\": "
    "...}]";

Block domain_of(const Shape& shape, Joints& joints) {
  Block domain{shape.loops, {}, 0, {}};
  for (const std::vector<std::string>& names : shape.edge_surface) {
    std::vector<std::uint32_t>& numbers = domain.edge_surface.emplace_back();
    for (const std::string& name : names) numbers.push_back(joints.number_of(name));
  }
  return domain;
}

double estimate(const Joints& joints, const Box& box) {
  std::vector<Density> sources{density_of(joints.cuts, box)};
  for (const JointSet& set : joints.sets) sources.push_back(density_of(set, box));
  if (joints.bricks) sources.push_back(density_of(*joints.bricks, box));
  if (joints.sites) sources.push_back(density_of(*joints.sites, box));
  return estimated_blocks(sources, box);
}

CutOrder order_of(const Shape& shape, Joints& joints, const Geos& geos) {
  CutOrder order;
  order.domain = domain_of(shape, joints);
  const Box box = box_around(shape.loops[0]);
  for (const JointSet& set : joints.sets) add_joints(set, box, order.cuts);
  order.cuts.insert(order.cuts.end(), joints.cuts.begin(), joints.cuts.end());
  if (joints.bricks) {
    add_bricks(*joints.bricks, box, order.cuts);
    order.is_void = [bricks = *joints.bricks, box](Vec2 point) { return bricks.in_gap(box, point); };
  }
  if (joints.sites) add_voronoi(*joints.sites, shape.loops, geos, order.cuts);
  return order;
}

Json vertices_of(const Ring& ring) {
  Json vertices = Json::array();
  for (const Vec2 vertex : ring) vertices.push_back(Json::array({vertex.x, vertex.y}));
  return vertices;
}

Json body_of(const Block& block, const std::string& name, const std::vector<std::string>& surfaces,
             const Json& generator) {
  Json body = Json::object();
  body["name"] = name;
  body["polygon"] = vertices_of(block.loops[0]);
  for (std::size_t i = 1; i < block.loops.size(); ++i) body["holes"].push_back(vertices_of(block.loops[i]));
  std::size_t edge = 0;
  for (const std::vector<std::uint32_t>& loop : block.edge_surface) {
    for (const std::uint32_t surface : loop) {
      if (surface != 0) body["surfaces"][surfaces[surface]].push_back(edge);
      ++edge;
    }
  }
  for (const char* key : shared_keys) {
    if (const auto shared = generator.find(key); shared != generator.end()) body[key] = *shared;
  }
  return body;
}

class Expander {
 public:
  Expander(Json& bodies, const Json& materials, const std::filesystem::path& folder, double most_blocks,
           Mistakes& mistakes)
      : bodies_(bodies),
        materials_(materials),
        folder_(folder),
        most_blocks_(most_blocks),
        mistakes_(mistakes) {}

  void take(const Json& written, const std::string& pointer) {
    const std::size_t mistakes_before = mistakes_.count();
    Section section(&written, pointer, mistakes_);
    const std::optional<std::string> given = take_name(section, "what the names of the blocks begin with");
    const std::string name = given.value_or("");
    const bool own_name = given && is_own(section, name);
    const Shape domain = read_domain(section);
    Joints joints = read_joints(section, folder_);
    check_surfaces(joints);
    const double smallest_area = section.value(table::of(table::blocks, "smallest_area"));
    const double smallest_share = section.value(table::of(table::blocks, "smallest_share"));
    for (const char* key : shared_keys) section.child(key);
    if (written.is_object() && !written.contains("material"))
      section.required_child("material", "the name of a material");
    section.finish();
    const std::size_t first = bodies_.size();
    if (mistakes_.count() == mistakes_before) {
      const CutDomain made = cut(section, domain, joints, smallest_area, smallest_share);
      for (std::size_t i = 0; i < made.blocks.size(); ++i)
        bodies_.push_back(
            body_of(made.blocks[i], fmt::format("{}_{}", name, i + 1), joints.surfaces, written));
      result.files.merge(joints.files);
      result.warnings.insert(result.warnings.end(), joints.warnings.begin(), joints.warnings.end());
      if (made.blocks.size() == 1) warn_of_one_block(section, name, made.pieces);
    }
    if (bodies_.size() == first && !name.empty()) {
      result.unmade.push_back(name);
      // The domain as a whole stands for the blocks, so that what they share is checked as well.
      if (domain.sound && own_name && written.contains("material"))
        bodies_.push_back(body_of(domain_of(domain, joints), name + "_1", joints.surfaces, written));
    }
    result.generated.push_back({first, bodies_.size() - first, pointer});
  }

  Expansion result;

 private:
  bool is_own(Section& section, const std::string& name) {
    const auto [known, is_new] = names_.emplace(name, section.pointer());
    if (is_new) return true;
    mistakes_.add(section.pointer_to("name"),
                  fmt::format("\"{}\" is the name of {} already: names must differ", name, known->second));
    return false;
  }

  /// Of joints, whose keys blocks do not have.
  void check_surfaces(const Joints& joints) {
    for (const NamingKey& key : joints.naming_keys) {
      if (!materials_.contains(key.surface)) continue;
      const std::string words =
          fmt::format("\"{}\" is the name of a material: interfaces could not tell the two apart, rename one",
                      key.surface);
      if (key.drawing.empty())
        mistakes_.add_at_key(key.pointer, words);
      else
        mistakes_.add(key.pointer, fmt::format("{}: layer {}", key.drawing, words));
    }
  }

  /// Lines of one set lie beside each other, and how long they take to cut grows with their square.
  bool check_lines(Section& section, const Joints& joints, const Box& box) {
    constexpr double most_lines = 1e4;
    bool good = true;
    for (std::size_t i = 0; i < joints.sets.size(); ++i) {
      const double lines = lines_of(joints.sets[i], box);
      if (lines <= most_lines) continue;
      good = false;
      mistakes_.add(
          below(section.pointer_to("joint_sets"), i) + "/spacing",
          fmt::format("{} would make about {:.3g} joints of one set: expected {:.0e} at most; is it "
                      "in metres?",
                      joints.sets[i].spacing, lines, most_lines));
    }
    return good;
  }

  void warn_of_one_block(const Section& section, const std::string& name, std::size_t pieces) {
    result.warnings.push_back(fmt::format(
        "{}: '{}' stays one block: {}", section.pointer(), name,
        pieces == 1 ? "nothing cuts its domain from side to side"
                    : fmt::format("lines cut its domain into {}, of which those below the smallest area, and "
                                  "slivers, joined their neighbours",
                                  pieces)));
  }

  void warn_of_loose_ends(const Section& section, const std::vector<LooseEnd>& ends, double size) {
    if (ends.empty()) return;
    const LooseEnd nearest = *std::min_element(
        ends.begin(), ends.end(), [](const LooseEnd& p, const LooseEnd& q) { return p.gap < q.gap; });
    result.warnings.push_back(
        fmt::format("{}: {} end{} of drawn lines within a block: nothing is cut from their last crossing "
                    "on; the one nearest to what is cut, at {}, is {:.3g} m from it",
                    section.pointer(), ends.size(), ends.size() == 1 ? "" : "s", place_text(nearest.at, size),
                    nearest.gap));
  }

  void warn_of_bridges(const Section& section, const std::vector<Vec2>& points, double size) {
    if (points.empty()) return;
    result.warnings.push_back(fmt::format(
        "{}: at {} point{}, the first {}, a block meets itself across a corner of "
        "what it encloses: 1 % of that corner's shorter side is cut off there, and goes to the "
        "block around",
        section.pointer(), points.size(), points.size() == 1 ? "" : "s", place_text(points[0], size)));
  }

  void warn_of_what_is_left_out(const Section& section, const CutDomain& made) {
    if (!(made.left_out > 0) || made.blocks.empty()) return;
    double all = made.left_out;
    for (const Block& block : made.blocks) all += block.area;
    result.warnings.push_back(fmt::format(
        "{}: {:.3g} m2 of {:.3g} m2 are left out: blocks below the smallest area that have no neighbour to "
        "join",
        section.pointer(), made.left_out, all));
  }

  /// Whether a segment has a point in a box (Liang–Barsky).
  static bool passes(Vec2 from, Vec2 to, const Box& box) {
    double first = 0, last = 1;
    const auto within = [&](double at, double way, double low, double high) {
      if (way == 0) return low <= at && at <= high;
      const double enters = ((way > 0 ? low : high) - at) / way, leaves = ((way > 0 ? high : low) - at) / way;
      first = std::max(first, enters);
      last = std::min(last, leaves);
      return first <= last;
    };
    return within(from.x, to.x - from.x, box.low.x, box.high.x) &&
           within(from.y, to.y - from.y, box.low.y, box.high.y);
  }

  static bool meets(const std::vector<Vec2>& line, const Box& domain) {
    for (std::size_t p = 1; p < line.size(); ++p) {
      if (passes(line[p - 1], line[p], domain)) return true;
    }
    return false;
  }

  /// Of units or an origin that do not fit, and of lines that name surfaces which then are nowhere.
  void warn_of_lines_elsewhere(const Section& section, const Joints& joints, const Box& domain) {
    const std::size_t given = joints.drawing.empty() ? joints.cuts.size() : joints.first_of_drawing;
    std::vector<std::size_t> outside;
    for (std::size_t i = 0; i < given; ++i) {
      if (!meets(joints.cuts[i].points, domain)) outside.push_back(i);
    }
    if (!outside.empty()) {
      result.warnings.push_back(
          fmt::format("{}: this joint {} outside the domain, which goes from {} to {}",
                      below(section.pointer_to("joints"), outside[0]),
                      outside.size() == 1 ? std::string("lies")
                                          : fmt::format("and {} more of {} lie", outside.size() - 1, given),
                      place_text(domain.low, domain.size()), place_text(domain.high, domain.size())));
    }
    if (!joints.drawing.empty()) warn_of_drawing_elsewhere(section, joints, domain);
  }

  void warn_of_drawing_elsewhere(const Section& section, const Joints& joints, const Box& domain) {
    std::vector<Vec2> points;
    std::set<std::uint32_t> within, beside;
    for (std::size_t i = joints.first_of_drawing; i < joints.cuts.size(); ++i) {
      const Cut& cut = joints.cuts[i];
      (meets(cut.points, domain) ? within : beside).insert(cut.surface);
      points.insert(points.end(), cut.points.begin(), cut.points.end());
    }
    if (points.empty()) return;
    const Box drawing = box_around(points);
    if (within.empty()) {
      result.warnings.push_back(fmt::format(
          "{}: no line of {} meets the domain: it is drawn from {} to {}, the domain goes from {} to {}; is "
          "it in metres, and are both from one origin?",
          section.pointer_to("dxf"), joints.drawing, place_text(drawing.low, drawing.size()),
          place_text(drawing.high, drawing.size()), place_text(domain.low, domain.size()),
          place_text(domain.high, domain.size())));
      return;
    }
    for (const std::uint32_t surface : beside) {
      if (within.count(surface) != 0 || surface == 0) continue;
      result.warnings.push_back(fmt::format("{}: {}: no line of layer '{}' meets the domain",
                                            section.pointer_to("dxf"), joints.drawing,
                                            joints.surfaces[surface]));
    }
  }

  void warn_of_names_of_one_line(const Section& section, const Joints& joints, const NamesOfOneLine& names) {
    for (const auto& [first, other] : names) {
      result.warnings.push_back(fmt::format(
          "{}: lines of the surfaces '{}' and '{}' lie on each other: the sides there are of '{}'",
          section.pointer(), joints.surfaces[first], joints.surfaces[other], joints.surfaces[first]));
    }
  }

  CutDomain cut(Section& section, const Shape& domain, Joints& joints, double smallest_area,
                double smallest_share) {
    const Box box = box_around(domain.loops[0]);
    const double blocks = estimate(joints, box);
    if (blocks > most_blocks_) {
      mistakes_.add(section.pointer(),
                    fmt::format("this would make about {:.3g} blocks: expected {:.0e} at most; are the "
                                "spacings in metres?",
                                blocks, most_blocks_));
      return {};
    }
    if (!check_lines(section, joints, box)) return {};
    try {
      const Geos geos;
      CutOrder order = order_of(domain, joints, geos);
      order.smallest_area = smallest_area;
      order.smallest_share = smallest_share;
      order.split_share = joints.split_share;
      order.split_seed = joints.split_seed;
      CutDomain made = cut_domain(order, geos);
      warn_of_lines_elsewhere(section, joints, box);
      warn_of_loose_ends(section, made.loose_ends, box.size());
      warn_of_bridges(section, made.bridged, box.size());
      warn_of_what_is_left_out(section, made);
      warn_of_names_of_one_line(section, joints, made.names_of_one_line);
      if (made.blocks.empty()) {
        mistakes_.add(
            section.pointer(),
            "no block is left: what there is lies in gaps, or is below the smallest area and has no "
            "neighbour to join");
      }
      return made;
    } catch (const std::runtime_error& failure) {
      mistakes_.add(section.pointer(), fmt::format("the domain could not be cut: {}", failure.what()));
      return {};
    }
  }

  Json& bodies_;
  const Json& materials_;
  const std::filesystem::path& folder_;
  double most_blocks_;
  Mistakes& mistakes_;
  std::map<std::string, std::string> names_;
};

}  // namespace

std::string Expansion::origin_of(const std::string& pointer) const {
  constexpr std::string_view bodies = "/bodies/";
  if (!pointer.starts_with(bodies)) return pointer;
  const std::size_t end = std::min(pointer.find('/', bodies.size()), pointer.size());
  std::size_t number = 0;
  if (std::from_chars(pointer.data() + bodies.size(), pointer.data() + end, number).ptr !=
      pointer.data() + end)
    return pointer;
  for (const Generated& part : generated) {
    if (number < part.first || number >= part.first + part.count) continue;
    const std::string rest = pointer.substr(end);
    const bool outline = rest.starts_with("/polygon") || rest.starts_with("/holes");
    return part.pointer + (outline ? "/domain" : rest);
  }
  return pointer;
}

Expansion expand_blocks(Json& scene, const std::filesystem::path& folder, double most_blocks,
                        Mistakes& mistakes) {
  const auto written = scene.find("blocks");
  if (written == scene.end()) return {};
  const Json generators = std::move(*written);
  scene.erase("blocks");
  if (!generators.is_array()) {
    mistakes.add("/blocks",
                 fmt::format("{} is not allowed here: expected {}", shown(generators), generators_expected));
    return {};
  }
  if (!scene.contains("bodies") && !generators.empty()) scene["bodies"] = Json::array();
  Json none = Json::array();
  Json& bodies = scene.contains("bodies") && scene["bodies"].is_array() ? scene["bodies"] : none;
  const auto found = scene.find("materials");
  const Json materials = found != scene.end() && found->is_object() ? *found : Json::object();
  Expander expander(bodies, materials, folder, most_blocks, mistakes);
  for (std::size_t i = 0; i < generators.size(); ++i) expander.take(generators[i], below("/blocks", i));
  return std::move(expander.result);
}

}  // namespace talus
