#include "model/covered_body.hpp"

#include "model/region.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace talus {
namespace {

Element element_of(const LaidCover& cover, const LaidCover::LaidElement& laid, std::uint32_t first_patch) {
  Element element;
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

/// Triangles of a lattice are alike: what tells them apart is rounding. Each gradient becomes the one of the
/// lattice that it is, whichever corner comes first.
void make_regular(Element& element, int sign, const RegularLattice& lattice) {
  const auto& g = lattice.gradient;
  const double s = sign;
  const std::array<Vec2, 3> all{Vec2{-s * (g[0] + g[2]), -s * (g[1] + g[3])}, Vec2{s * g[0], s * g[1]},
                                Vec2{s * g[2], s * g[3]}};
  for (Vec2& gradient : element.gradient) {
    const auto off = [&](Vec2 other) {
      const Vec2 apart = other - gradient;
      return dot(apart, apart);
    };
    gradient = *std::min_element(all.begin(), all.end(), [&](Vec2 p, Vec2 q) { return off(p) < off(q); });
  }
}

/// Side of an equilateral triangle as large as that of the star points, m.
double size_of(const Element& element) {
  const Vec2 g = element.gradient[0], h = element.gradient[1];
  const double twice_area = 1 / std::abs(g.x * h.y - g.y * h.x);
  return std::sqrt(twice_area * 2 / std::sqrt(3.0));
}

/// Row sums of the consistent mass (Eq. 17): ρ∫w_i, exact on the cut region.
void add_mass(Model& model, const Element& element, const LaidCover::LaidElement& laid, double area,
              double density) {
  if (laid.lattice != 0) {
    for (const std::uint32_t patch : element.patch) model.patch_mass[patch] += density * area / 3;
    return;
  }
  const AreaMoments& region = laid.moments;
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
  CoverRanges& ranges = model.ranges(body);
  ranges.side_begin = static_cast<std::uint32_t>(model.sides.size());
  std::size_t outline = scene_body.outer.surface_class.size();
  for (const Loop& hole : scene_body.holes) outline += hole.surface_class.size();
  for (const auto& loop : cover.loops) {
    const auto first = static_cast<std::uint32_t>(model.sides.size());
    const auto count = static_cast<std::uint32_t>(loop.size());
    const auto point = [&](const LaidCover::BoundaryVertex& vertex) {
      return MaterialPoint{index, vertex.at, model.carrier(elements[vertex.element], vertex.at)};
    };
    for (std::uint32_t i = 0; i < count; ++i) {
      model.sides.push_back({point(loop[i]), point(loop[(i + 1) % count]),
                             surface_of(scene_body, loop[i].side), loop[i].side >= outline});
      model.next_side.push_back(first + (i + 1) % count);
      model.previous_side.push_back(first + (i + count - 1) % count);
      model.side_size.push_back(size_of(elements[loop[i].element]));
    }
  }
  ranges.side_end = static_cast<std::uint32_t>(model.sides.size());
}

void list_outer_patches(Model& model, const Body& body, const std::vector<Element>& elements,
                        const double* area) {
  constexpr double rounding = 1e-12;  // of all that was added up
  CoverRanges& ranges = model.ranges(body);
  struct Sum {
    Vec2 all{0, 0};
    double size = 0;
  };
  std::vector<Sum> sums(ranges.patch_end - ranges.patch_begin);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 g = elements[e].gradient[i];
      Sum& sum = sums[elements[e].patch[i] - ranges.patch_begin];
      sum.all += area[e] * g;
      sum.size += area[e] * (std::abs(g.x) + std::abs(g.y));
    }
  }
  const double whole = std::accumulate(area, area + elements.size(), 0.0);
  ranges.outer_begin = static_cast<std::uint32_t>(model.outer_patches.size());
  for (std::uint32_t p = 0; p < sums.size(); ++p) {
    const auto& [all, size] = sums[p];
    if (!(std::abs(all.x) + std::abs(all.y) > rounding * size)) continue;
    model.outer_patches.push_back({ranges.patch_begin + p, all / whole});
  }
  ranges.outer_end = static_cast<std::uint32_t>(model.outer_patches.size());
}

/// A tied patch hands its mass to those it follows; one with added inertia keeps its own.
void steady_patches(Model& model, Body& body, const LaidCover& cover, double density) {
  CoverRanges& ranges = model.ranges(body);
  model.row_sum.resize(model.patch_mass.size());
  std::copy(model.patch_mass.begin() + ranges.patch_begin, model.patch_mass.end(),
            model.row_sum.begin() + ranges.patch_begin);
  ranges.steady_begin = static_cast<std::uint32_t>(model.steady.size());
  for (const LaidCover::Steadied& one : cover.steadied) {
    SteadyPatch steady{ranges.patch_begin + one.patch, {}, density * one.inertia_area};
    steady.to.weight = one.weights;
    for (std::size_t i = 0; i < 3; ++i) steady.to.patch[i] = ranges.patch_begin + one.to[i];
    model.steady.push_back(steady);
    if (std::isfinite(one.inertia_area)) continue;
    for (std::size_t i = 0; i < 3; ++i)
      model.patch_mass[steady.to.patch[i]] += one.weights[i] * model.patch_mass[steady.patch];
    model.patch_mass[steady.patch] = 0;
  }
  ranges.steady_end = static_cast<std::uint32_t>(model.steady.size());
}

void check_masses(const Model& model, const Body& body, const SceneBody& scene_body) {
  const CoverRanges& ranges = model.ranges(body);
  std::vector<char> tied(ranges.patch_end - ranges.patch_begin, 0);
  for (std::uint32_t s = ranges.steady_begin; s < ranges.steady_end; ++s)
    tied[model.steady[s].patch - ranges.patch_begin] = std::isinf(model.steady[s].inertia) ? 1 : 0;
  for (std::uint32_t p = ranges.patch_begin; p < ranges.patch_end; ++p) {
    if (tied[p - ranges.patch_begin] != 0 || model.patch_mass[p] > 0) continue;
    throw PluginError(fmt::format("{}: cover '{}' gives patch {} of body '{}' a mass of {:.3g} kg/m",
                                  scene_body.cover.component->file.string(),
                                  scene_body.cover.component->component->name, p - ranges.patch_begin,
                                  scene_body.name, model.patch_mass[p]));
  }
}

/// Mean mass of the patches that carry the boundary: what a contact feels at once.
double boundary_mass(const Model& model, const Body& body) {
  const CoverRanges& ranges = model.ranges(body);
  std::vector<char> counted(ranges.patch_end - ranges.patch_begin, 0);
  double sum = 0;
  std::size_t count = 0;
  for (std::uint32_t side = ranges.side_begin; side < ranges.side_end; ++side) {
    for (const std::uint32_t patch : model.sides[side].start.carrier.patch) {
      char& seen = counted[patch - ranges.patch_begin];
      if (seen != 0 || !(model.patch_mass[patch] > 0)) continue;
      seen = 1;
      sum += model.patch_mass[patch];
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : body.mass;
}

/// Elements that may turn out to carry a point: those nearest to it, and what is as near but for rounding.
std::vector<std::uint32_t> carrying(const LaidCover& cover, const std::vector<Vec2>& points) {
  std::vector<std::uint32_t> result;
  for (const Vec2 point : points) {
    double nearest = std::numeric_limits<double>::infinity(), reach = 0;
    std::vector<std::pair<double, std::uint32_t>> found;
    for (std::uint32_t e = 0; e < cover.elements.size(); ++e) {
      const LaidCover::LaidElement& element = cover.elements[e];
      const std::array<double, 4> box = box_of(element.region);
      reach = std::max(reach, 1e-6 * std::max(box[2] - box[0], box[3] - box[1]));
      const auto within = [&](double squared) { return std::sqrt(squared) <= std::sqrt(nearest) + reach; };
      if (!within(squared_distance(box, point))) continue;
      const double distance = squared_distance(element.region, point);
      if (!within(distance)) continue;
      nearest = std::min(nearest, distance);
      found.emplace_back(distance, e);
    }
    for (const auto& [distance, element] : found) {
      if (std::sqrt(distance) <= std::sqrt(nearest) + reach) result.push_back(element);
    }
  }
  return result;
}

/// The triangles of any shape of a body, as its subdomains go through them. `areas`: [element] m².
void fill_triangles(Model& model, const Body& body, const std::vector<Element>& elements,
                    const double* areas) {
  const CoverRanges& ranges = model.ranges(body);
  Partition& partition = model.partition;
  for (auto& component : partition.gradient) component.resize(partition.corner.size());
  for (std::uint32_t s = ranges.subdomain_begin; s < ranges.subdomain_end; ++s) {
    const Subdomain& subdomain = partition.subdomains[s];
    for (std::uint32_t c = subdomain.chunk_begin; c < subdomain.chunk_end; ++c) {
      const ElementChunk& chunk = partition.chunks[c];
      std::uint32_t next = chunk.element;
      for (std::uint32_t i = chunk.link; i < chunk.link + chunk.links; ++i) {
        if (partition.area[i] == 0) continue;
        const Element& element = elements[next];
        const std::array<double, 4> gradient{element.gradient[1].x, element.gradient[1].y,
                                             element.gradient[2].x, element.gradient[2].y};
        for (std::size_t k = 0; k < 4; ++k) partition.gradient[k][i] = gradient[k];
        partition.area[i] = areas[next++];
      }
    }
    for (std::uint32_t r = subdomain.run_begin; r < subdomain.run_end; ++r) {
      PatchRun& run = partition.runs[r];
      const auto first = model.patch_mass.begin() + run.patch;
      const bool same = std::all_of(first, first + run.count, [&](double mass) { return mass == *first; });
      run.mass = same ? *first : 0;
    }
  }
}

/// The slots of each common patch of a body, in the order of the subdomains.
void list_slots(Partition& partition, CoverRanges& ranges) {
  ranges.common_index = partition.common_count();
  if (partition.common_start.empty()) partition.common_start.push_back(0);
  const std::uint32_t count = ranges.patch_end - ranges.own_end;
  const std::uint32_t begin = partition.subdomains[ranges.subdomain_begin].slot_begin;
  const std::uint32_t end = partition.subdomains[ranges.subdomain_end - 1].slot_end;
  std::vector<std::uint32_t> start(count + 1, 0);
  for (std::uint32_t s = begin; s < end; ++s) ++start[partition.slot_patch[s] - ranges.own_end + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  for (std::uint32_t i = 1; i <= count; ++i) partition.common_start.push_back(begin + start[i]);
  partition.common_slot.resize(end);
  for (std::uint32_t s = begin; s < end; ++s)
    partition.common_slot[begin + start[partition.slot_patch[s] - ranges.own_end]++] = s;
}

}  // namespace

void add_covered_body(Model& model, const SceneBody& scene_body, std::uint32_t index, LaidCover cover,
                      double density, const std::vector<Vec2>& loaded) {
  Body& body = model.bodies[index];
  body.ranges = static_cast<std::uint32_t>(model.cover_ranges.size());
  CoverRanges& ranges = model.cover_ranges.emplace_back();
  ranges.patch_begin = static_cast<std::uint32_t>(model.patch_star.size());
  ranges.subdomain_begin = static_cast<std::uint32_t>(model.partition.subdomains.size());
  ranges.lattice = static_cast<std::uint32_t>(model.partition.lattices.size());
  const PartitionCounts counts =
      partition_cover(model.partition, cover, carrying(cover, loaded), ranges.patch_begin);
  ranges.own_end = ranges.patch_begin + counts.own;
  ranges.free_end = ranges.patch_begin + counts.free;
  ranges.subdomain_end = static_cast<std::uint32_t>(model.partition.subdomains.size());
  const RegularLattice& lattice = model.partition.lattices[ranges.lattice];
  model.patch_star.insert(model.patch_star.end(), cover.patches.begin(), cover.patches.end());
  model.patch_mass.resize(model.patch_star.size(), 0.0);
  ranges.patch_end = static_cast<std::uint32_t>(model.patch_star.size());

  std::vector<Element> elements;
  double size = 0;
  elements.reserve(cover.elements.size());
  const std::size_t first = model.element_body.size();
  model.elements.resize(first);  // affine blocks before have none
  model.element_region.resize(first);
  for (LaidCover::LaidElement& laid : cover.elements) {
    elements.push_back(element_of(cover, laid, ranges.patch_begin));
    if (laid.lattice != 0) make_regular(elements.back(), laid.lattice, lattice);
    const double area = laid.lattice != 0 ? lattice.area : laid.moments.area;
    add_mass(model, elements.back(), laid, area, density);
    size += size_of(elements.back());
    model.element_body.push_back(index);
    model.element_area.push_back(area);
    model.elements.push_back(elements.back());
    model.element_region.push_back(std::move(laid.region));
  }
  steady_patches(model, body, cover, density);
  check_masses(model, body, scene_body);
  list_outer_patches(model, body, elements, model.element_area.data() + first);
  fill_triangles(model, body, elements, model.element_area.data() + first);
  list_slots(model.partition, ranges);
  add_sides(model, scene_body, index, cover, elements);
  body.width = std::min(body.width, size / static_cast<double>(elements.size()));
  body.contact_mass = boundary_mass(model, body);
  body.meets_itself = scene_body.self_contact || !scene_body.discontinuities.empty();
  body.outline_meets = scene_body.self_contact;
}

}  // namespace talus
