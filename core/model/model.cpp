#include "model/model.hpp"

#include "geometry/convex_pieces.hpp"
#include "model/covered_body.hpp"
#include "model/laid_cover.hpp"
#include "model/region.hpp"
#include "model/strips.hpp"
#include "scene/source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <set>

namespace talus {
namespace {

AreaMoments moments_about(const SceneBody& body, Vec2 centre) {
  AreaMoments sum = ring_moments(body.outer.vertices, centre);
  for (const Loop& hole : body.holes) sum = sum + ring_moments(hole.vertices, centre);
  return sum;
}

void set_mass(Body& body, double density) {
  body.mass = body.contact_mass = density * body.moments.area;
}

std::vector<ConvexPiece> pieces_of(const SceneBody& body) {
  try {
    return convex_pieces(body.outer, body.holes);
  } catch (const Indivisible& problem) {
    throw BodyRefused(fmt::format("body '{}': {}", body.name, problem.what()));
  }
}

/// The convex pieces of a body that moves as a whole.
void add_pieces(Model& model, const SceneBody& scene_body, const Body& body, std::uint32_t index) {
  for (const ConvexPiece& piece : pieces_of(scene_body)) {
    for (const PieceCorner& corner : piece) {
      model.reference_x.push_back(corner.at.x - body.centre.x);
      model.reference_y.push_back(corner.at.y - body.centre.y);
      model.surface.push_back(corner.surface);
      model.cut.push_back(corner.cut);
    }
    model.piece_body.push_back(index);
    model.piece_start.push_back(static_cast<std::uint32_t>(model.surface.size()));
    model.is_strip.push_back(0);
    model.piece_strip.push_back(0);
  }
}

void add_element_of_block(Model& model, std::uint32_t index) {
  model.element_body.push_back(index);
  model.element_area.push_back(model.bodies[index].moments.area);
}

/// Where point loads act on a body in any stage, relative to its centroid.
std::vector<Vec2> loaded_points(const Scene& scene, std::uint32_t body, Vec2 centre) {
  std::vector<Vec2> points;
  const auto append = [&](const std::vector<PointLoad>& loads) {
    for (const PointLoad& load : loads) {
      if (load.body == body) points.push_back(load.point - centre);
    }
  };
  append(scene.loads);
  for (const Stage& stage : scene.stages) append(stage.settings.loads);
  return points;
}

/// Outlines of fragments can meet, which only now is known to be several.
void check_fragments(const Model& model, const Scene& scene, std::uint32_t index) {
  const Body& body = model.bodies[index];
  if (!body.meets_itself || body.outline_meets || scene.without_interface.empty()) return;
  std::map<std::uint32_t, std::set<std::uint32_t>> fragments_with;  // [surface] of the outline
  for (std::uint32_t piece = body.piece_begin; piece < model.piece_body.size(); ++piece) {
    const Strip& strip = model.strips[model.piece_strip[piece]];
    const BoundarySide& side = model.sides[strip.side];
    if (!side.is_cut_face) fragments_with[side.surface].insert(strip.fragment);
  }
  for (const auto& [a, b] : scene.without_interface) {
    const std::set<std::uint32_t>&with_a = fragments_with[a], &with_b = fragments_with[b];
    const auto meets_another = [&](std::uint32_t fragment) {
      return with_b.size() > (with_b.contains(fragment) ? 1U : 0U);
    };
    if (std::none_of(with_a.begin(), with_a.end(), meets_another)) continue;
    const auto name = [&](std::uint32_t surface) {
      const SurfaceClass& one = scene.surfaces[surface];
      return one.surface.empty() ? one.material : one.surface;
    };
    throw BodyRefused(
        fmt::format("the discontinuities of body '{}' cut it apart, and no row of /interfaces covers \"{}\" "
                    "against \"{}\", with which its fragments can meet: add a row between the two",
                    scene.bodies[index].name, name(a), name(b)));
  }
}

void add_body(Model& model, const Scene& scene, std::uint32_t index) {
  const SceneBody& scene_body = scene.bodies[index];
  Body& body = model.bodies.emplace_back();
  const Vec2 first = scene_body.outer.vertices.front();
  const AreaMoments about_first = moments_about(scene_body, first);
  body.centre = {first.x + about_first.x / about_first.area, first.y + about_first.y / about_first.area};
  body.moments = about_centroid(moments_about(scene_body, body.centre));
  body.width = smallest_width(scene_body.outer.vertices);
  body.piece_begin = static_cast<std::uint32_t>(model.piece_body.size());
  body.corner_begin = static_cast<std::uint32_t>(model.surface.size());
  if (!scene_body.fixed) {
    const double density = scene.materials[scene_body.material].density;
    LaidCover cover = lay_cover(scene_body, body);
    set_mass(body, density);
    if (cover.rigid) {
      body.kinematics = Kinematics::rigid;
    } else if (cover.elements.size() == 1 && cover.patches.size() == 3) {
      body.kinematics = Kinematics::affine;
      body.strain_mass_scale = cover.strain_mass_scale;
      add_element_of_block(model, index);
    } else {
      body.kinematics = Kinematics::covered;
      add_covered_body(model, scene_body, index, std::move(cover), density,
                       loaded_points(scene, index, body.centre));
    }
  }
  if (scene_body.self_contact && !model.covered(index)) {
    throw BodyRefused(
        fmt::format("body '{}' has \"self_contact\", but is one element, which cannot meet itself: "
                    "take the cover \"hexagonal\" or \"mesh\"",
                    scene_body.name));
  }
  if (model.covered(index)) {
    add_strips(model, index);
    check_fragments(model, scene, index);
  } else {
    add_pieces(model, scene_body, body, index);
  }
  body.piece_end = static_cast<std::uint32_t>(model.piece_body.size());
  body.corner_end = static_cast<std::uint32_t>(model.surface.size());
}

/// So that arrays of bodies that move as a whole, by far the most, need not grow, which would leave holes.
void make_room(Model& model, const Scene& scene) {
  model.bodies.reserve(scene.bodies.size());
  std::size_t corners = 0, pieces = 0;
  for (const SceneBody& body : scene.bodies) {
    corners += body.outer.vertices.size();
    pieces += 1;
  }
  model.reference_x.reserve(corners);
  model.reference_y.reserve(corners);
  model.surface.reserve(corners);
  model.cut.reserve(corners);
  model.piece_body.reserve(pieces);
  model.piece_start.reserve(pieces + 1);
  model.is_strip.reserve(pieces);
  model.piece_strip.reserve(pieces);
  model.element_body.reserve(pieces);
  model.element_area.reserve(pieces);
}

/// One batch per material needs the elements side by side.
void sort_elements(Model& model, const Scene& scene) {
  const auto material = [&](std::uint32_t e) { return scene.bodies[model.element_body[e]].material; };
  std::vector<std::uint32_t> order(model.element_body.size());
  std::iota(order.begin(), order.end(), 0);
  const auto before = [&](std::uint32_t a, std::uint32_t b) { return material(a) < material(b); };
  const bool sorted = std::is_sorted(order.begin(), order.end(), before);
  if (!sorted) std::stable_sort(order.begin(), order.end(), before);
  model.body_element.resize(order.size());
  model.material_element_start.assign(scene.materials.size() + 1, 0);
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    model.body_element[order[i]] = i;
    ++model.material_element_start[material(order[i]) + 1];
  }
  std::partial_sum(model.material_element_start.begin(), model.material_element_start.end(),
                   model.material_element_start.begin());
  std::uint32_t entry = 0;
  for (std::uint32_t body = 0; body < model.bodies.size(); ++body) {
    model.bodies[body].element_begin = entry;
    while (entry < order.size() && model.element_body[entry] == body) ++entry;
    model.bodies[body].element_end = entry;
  }
  if (!model.elements.empty()) {  // after the last, affine blocks have none
    model.elements.resize(order.size());
    model.element_region.resize(order.size());
  }
  if (sorted) return;
  const auto reorder = [&](auto& of_elements) {
    if (of_elements.empty()) return;
    auto listed = std::move(of_elements);
    of_elements.clear();
    of_elements.reserve(order.size());
    for (const std::uint32_t e : order) of_elements.push_back(std::move(listed[e]));
  };
  reorder(model.element_body);
  reorder(model.element_area);
  reorder(model.elements);
  reorder(model.element_region);
}

void measure_widths(Model& model) {
  double sum = 0;
  std::size_t moving = 0;
  model.smallest_width = std::numeric_limits<double>::infinity();
  for (const Body& body : model.bodies) {
    if (body.kinematics == Kinematics::fixed) continue;
    sum += body.width;
    ++moving;
    model.smallest_width = std::min(model.smallest_width, body.width);
  }
  model.mean_width = moving > 0 ? sum / static_cast<double>(moving) : 0;
}

}  // namespace

Matrix2 Body::inverse_moment() const {
  const double determinant = density() * (moments.xx * moments.yy - moments.xy * moments.xy);
  return {moments.yy / determinant, -moments.xy / determinant, -moments.xy / determinant,
          moments.xx / determinant};
}

std::uint32_t Model::element_at(std::uint32_t body, Vec2 reference) const {
  std::uint32_t best = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = bodies[body].element_begin; i < bodies[body].element_end && nearest > 0; ++i) {
    if (squared_distance(element_box[body_element[i]], reference) >= nearest) continue;
    const double distance = squared_distance(element_region[body_element[i]], reference);
    if (distance >= nearest) continue;
    nearest = distance;
    best = body_element[i];
  }
  return best;
}

MaterialPoint Model::point(std::uint32_t body, Vec2 reference) const {
  if (!covered(body)) return {body, reference, {}};
  return {body, reference, carrier(elements[element_at(body, reference)], reference)};
}

Carrier Model::carrier(const Element& element, Vec2 reference) const {
  Carrier result{element.patch, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    // From the next star point, where the weight is 0.
    const Vec2 zero = patch_star[element.patch[(i + 1) % 3]], g = element.gradient[i];
    result.weight[i] = g.x * (reference.x - zero.x) + g.y * (reference.y - zero.y);
  }
  return result;
}

std::vector<BoundarySide> boundary_of(const Scene& scene, const Model& model, std::uint32_t index) {
  const Body& body = model.bodies[index];
  const CoverRanges& ranges = model.ranges(body);
  if (model.covered(index))
    return {model.sides.begin() + ranges.side_begin, model.sides.begin() + ranges.side_end};
  std::vector<BoundarySide> sides;
  each_loop(scene.bodies[index], [&](const Loop& loop) {
    const std::size_t count = loop.vertices.size();
    const auto point = [&](std::size_t i) {
      const Vec2 at = loop.vertices[i % count];
      return MaterialPoint{index, at - body.centre, {}};
    };
    for (std::size_t i = 0; i < count; ++i) sides.push_back({point(i), point(i + 1), loop.surface_class[i]});
  });
  return sides;
}

Model build_model(const Scene& scene, std::span<const std::uint32_t> given) {
  Model model;
  model.piece_start.push_back(0);
  make_room(model, scene);
  std::vector<RefusedBody> refused;
  for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
    try {
      add_body(model, scene, i);
    } catch (const BodyRefused& problem) {
      refused.push_back({given.empty() ? i : given[i], problem.what()});
    }
  }
  if (!refused.empty()) throw error_of(scene, refused);
  sort_elements(model, scene);
  measure_widths(model);
  for (std::uint32_t i = 0; i < model.bodies.size(); ++i) {
    if (model.moves(i)) model.moving_bodies.push_back(i);
    if (model.covered(i)) model.covered_bodies.push_back(i);
  }
  if (model.covered_bodies.empty()) model.piece_strip.clear();
  for (const std::vector<Ring>& region : model.element_region) model.element_box.push_back(box_of(region));
  const auto fit = [](auto&... grown) { (grown.shrink_to_fit(), ...); };
  fit(model.reference_x, model.reference_y, model.surface, model.cut, model.piece_start, model.piece_body,
      model.is_strip, model.piece_strip, model.strips, model.competitors, model.sides, model.next_side,
      model.previous_side, model.side_size, model.element_body, model.element_area, model.elements,
      model.element_region);
  return model;
}

}  // namespace talus
