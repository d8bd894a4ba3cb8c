#include "model/covered_body.hpp"

#include "model/strips.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

Element element_of(const LaidCover& cover, const LaidCover::LaidElement& laid, std::uint32_t body,
                   std::uint32_t first_patch) {
  Element element;
  element.body = body;
  element.area = laid.moments.area;
  const Vec2 a = cover.patches[laid.patches[0]], b = cover.patches[laid.patches[1]],
             c = cover.patches[laid.patches[2]];
  const double twice_area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  const std::array<Vec2, 3> star{a, b, c};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 p = star[(i + 1) % 3], q = star[(i + 2) % 3];
    element.patch[i] = first_patch + laid.patches[i];
    element.gradient[i] = {(p.y - q.y) / twice_area, (q.x - p.x) / twice_area};
  }
  return element;
}

/// Side of an equilateral triangle as large as that of the star points, m.
double size_of(const Element& element) {
  const Vec2 g = element.gradient[0], h = element.gradient[1];
  const double twice_area = 1 / std::abs(g.x * h.y - g.y * h.x);
  return std::sqrt(twice_area * 2 / std::sqrt(3.0));
}

/// Row sums of the consistent mass (Eq. 17): ρ∫w_i, exact on the cut region.
void add_mass(Model& model, const Element& element, const AreaMoments& region, double density) {
  const Vec2 centroid{region.x / region.area, region.y / region.area};
  const Carrier carrier = model.carrier(element, centroid);
  for (std::size_t i = 0; i < 3; ++i)
    model.patch_mass[element.patch[i]] += density * region.area * carrier.weight[i];
}

std::uint32_t surface_of(const SceneBody& body, std::uint32_t side) {
  const auto in_loop = [&](const Loop& loop) { return side < loop.surface_class.size(); };
  if (in_loop(body.outer)) return body.outer.surface_class[side];
  side -= static_cast<std::uint32_t>(body.outer.surface_class.size());
  for (const Loop& hole : body.holes) {
    if (in_loop(hole)) return hole.surface_class[side];
    side -= static_cast<std::uint32_t>(hole.surface_class.size());
  }
  for (const Discontinuity& line : body.discontinuities) {
    if (side < line.points.size()) return line.surface_class;
    side -= static_cast<std::uint32_t>(line.points.size());
  }
  return 0;
}

void add_sides(Model& model, const SceneBody& scene_body, std::uint32_t index, const LaidCover& cover,
               const std::vector<Element>& elements) {
  Body& body = model.bodies[index];
  body.side_begin = static_cast<std::uint32_t>(model.sides.size());
  for (const auto& loop : cover.loops) {
    const auto first = static_cast<std::uint32_t>(model.sides.size());
    const auto count = static_cast<std::uint32_t>(loop.size());
    const auto point = [&](const LaidCover::BoundaryVertex& vertex) {
      return MaterialPoint{index, vertex.at, model.carrier(elements[vertex.element], vertex.at)};
    };
    for (std::uint32_t i = 0; i < count; ++i) {
      model.sides.push_back(
          {point(loop[i]), point(loop[(i + 1) % count]), surface_of(scene_body, loop[i].side)});
      model.next_side.push_back(first + (i + 1) % count);
      model.previous_side.push_back(first + (i + count - 1) % count);
      model.side_size.push_back(size_of(elements[loop[i].element]));
    }
  }
  body.side_end = static_cast<std::uint32_t>(model.sides.size());
}

/// A tied patch hands its mass to those it follows; one with added inertia keeps its own.
void steady_patches(Model& model, Body& body, const LaidCover& cover, double density) {
  model.row_sum.resize(model.patch_mass.size());
  std::copy(model.patch_mass.begin() + body.patch_begin, model.patch_mass.end(),
            model.row_sum.begin() + body.patch_begin);
  body.steady_begin = static_cast<std::uint32_t>(model.steady.size());
  for (const LaidCover::Steadied& one : cover.steadied) {
    SteadyPatch steady{body.patch_begin + one.patch, {}, density * one.inertia_area};
    steady.to.weight = one.weights;
    for (std::size_t i = 0; i < 3; ++i) steady.to.patch[i] = body.patch_begin + one.to[i];
    model.steady.push_back(steady);
    if (std::isfinite(one.inertia_area)) continue;
    for (std::size_t i = 0; i < 3; ++i)
      model.patch_mass[steady.to.patch[i]] += one.weights[i] * model.patch_mass[steady.patch];
    model.patch_mass[steady.patch] = 0;
  }
  body.steady_end = static_cast<std::uint32_t>(model.steady.size());
}

void check_masses(const Model& model, const Body& body, const SceneBody& scene_body) {
  std::vector<char> tied(body.patch_end - body.patch_begin, 0);
  for (std::uint32_t s = body.steady_begin; s < body.steady_end; ++s)
    tied[model.steady[s].patch - body.patch_begin] = std::isinf(model.steady[s].inertia) ? 1 : 0;
  for (std::uint32_t p = body.patch_begin; p < body.patch_end; ++p) {
    if (tied[p - body.patch_begin] != 0 || model.patch_mass[p] > 0) continue;
    throw PluginError(fmt::format("cover '{}' gives patch {} of body '{}' a mass of {:.3g} kg/m",
                                  scene_body.cover.component->component->name, p - body.patch_begin,
                                  scene_body.name, model.patch_mass[p]));
  }
}

/// Mean mass of the patches that carry the boundary: what a contact feels at once.
double boundary_mass(const Model& model, const Body& body) {
  std::vector<char> counted(body.patch_end - body.patch_begin, 0);
  double sum = 0;
  std::size_t count = 0;
  for (std::uint32_t side = body.side_begin; side < body.side_end; ++side) {
    for (const std::uint32_t patch : model.sides[side].start.carrier.patch) {
      char& seen = counted[patch - body.patch_begin];
      if (seen != 0 || !(model.patch_mass[patch] > 0)) continue;
      seen = 1;
      sum += model.patch_mass[patch];
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : body.mass;
}

}  // namespace

void add_covered_body(Model& model, const SceneBody& scene_body, std::uint32_t index, const LaidCover& cover,
                      double density) {
  Body& body = model.bodies[index];
  body.patch_begin = static_cast<std::uint32_t>(model.patch_star.size());
  model.patch_star.insert(model.patch_star.end(), cover.patches.begin(), cover.patches.end());
  model.patch_mass.resize(model.patch_star.size(), 0.0);
  body.patch_end = static_cast<std::uint32_t>(model.patch_star.size());

  std::vector<Element> elements;
  double size = 0;
  for (const LaidCover::LaidElement& laid : cover.elements) {
    elements.push_back(element_of(cover, laid, index, body.patch_begin));
    add_mass(model, elements.back(), laid.moments, density);
    size += size_of(elements.back());
    model.elements.push_back(elements.back());
    model.element_region.push_back(laid.region);
  }
  steady_patches(model, body, cover, density);
  check_masses(model, body, scene_body);
  add_sides(model, scene_body, index, cover, elements);
  body.width = std::min(body.width, size / static_cast<double>(elements.size()));
  body.contact_mass = boundary_mass(model, body);
  body.meets_itself = scene_body.self_contact || !scene_body.discontinuities.empty();
}

}  // namespace talus
