#include "model/laid_cover.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

/// Takes what a cover builder makes of one body.
class Sink final : public CoverSink {
 public:
  std::uint32_t add_patch(double x, double y) noexcept override {
    cover.patches.push_back({x, y});
    return static_cast<std::uint32_t>(cover.patches.size() - 1);
  }

  std::uint32_t add_element(const std::uint32_t patches[3], const Region& region) noexcept override {
    LaidCover::LaidElement& element = cover.elements.emplace_back();
    element.patches = {patches[0], patches[1], patches[2]};
    element.moments = {};
    for (std::uint32_t r = 0; r < region.ring_count; ++r) {
      Ring& ring = element.region.emplace_back();
      for (std::uint32_t i = region.ring_start[r]; i < region.ring_start[r + 1]; ++i)
        ring.push_back({region.x[i], region.y[i]});
      if (!ring.empty()) element.moments = element.moments + moments_of(ring);
    }
    return static_cast<std::uint32_t>(cover.elements.size() - 1);
  }

  void add_boundary_vertex(double x, double y, std::uint32_t element, std::uint32_t side) noexcept override {
    open_loop_.push_back({{x, y}, element, side});
  }

  void close_boundary_loop() noexcept override {
    cover.loops.push_back(std::move(open_loop_));
    open_loop_.clear();
  }

  void steady_patch(std::uint32_t patch, const std::uint32_t to[3], const double weights[3],
                    double inertia_area) noexcept override {
    cover.steadied.push_back(
        {patch, {to[0], to[1], to[2]}, {weights[0], weights[1], weights[2]}, inertia_area});
  }

  void scale_strain_mass(double scale) noexcept override { cover.strain_mass_scale = scale; }
  void make_rigid() noexcept override { cover.rigid = true; }
  void refuse(const char* why) noexcept override { refusal = words_of_plugin(why != nullptr ? why : ""); }

  LaidCover cover;
  std::string refusal;

 private:
  /// About the body's centroid, taken about a corner of the ring first: a sliver keeps its digits.
  static AreaMoments moments_of(const Ring& ring) {
    const AreaMoments m = ring_moments(ring, ring[0]);
    const Vec2 c = ring[0];
    return {m.area,
            m.x + c.x * m.area,
            m.y + c.y * m.area,
            m.xx + 2 * c.x * m.x + c.x * c.x * m.area,
            m.xy + c.x * m.y + c.y * m.x + c.x * c.y * m.area,
            m.yy + 2 * c.y * m.y + c.y * c.y * m.area};
  }

  std::vector<LaidCover::BoundaryVertex> open_loop_;
};

/// What a builder is given, kept alive while it works.
struct GivenShape {
  GivenShape(const SceneBody& scene_body, const Body& body) {
    const auto local = [&](Vec2 p) { return p - body.centre; };
    const auto append = [&](const std::vector<Vec2>& points, std::vector<double>& to_x,
                            std::vector<double>& to_y, std::vector<std::uint32_t>& start) {
      for (const Vec2& p : points) {
        to_x.push_back(local(p).x);
        to_y.push_back(local(p).y);
      }
      start.push_back(static_cast<std::uint32_t>(to_x.size()));
    };
    each_loop(scene_body, [&](const Loop& loop) { append(loop.vertices, x, y, ring_start); });
    for (const Vec2& p : scene_body.outer.vertices)
      farthest = std::max({farthest, std::abs(p.x), std::abs(p.y)});
    for (const Discontinuity& line : scene_body.discontinuities)
      append(line.points, line_x, line_y, line_start);
    std::vector<std::uint32_t> unused;
    append(scene_body.mesh.nodes, node_x, node_y, unused);
    for (const auto& triangle : scene_body.mesh.corners)
      corners.insert(corners.end(), triangle.begin(), triangle.end());
    shape = {
        {x.data(), y.data(), ring_start.data(), static_cast<std::uint32_t>(ring_start.size() - 1)},
        {body.moments.area, 0, 0, body.moments.xx, body.moments.xy, body.moments.yy},
        {line_x.data(), line_y.data(), line_start.data(), static_cast<std::uint32_t>(line_start.size() - 1)},
        {node_x.data(), node_y.data(), reinterpret_cast<const std::uint32_t(*)[3]>(corners.data()),
         static_cast<std::uint32_t>(node_x.size()), static_cast<std::uint32_t>(corners.size() / 3)}};
  }

  std::vector<double> x, y, line_x, line_y, node_x, node_y;
  std::vector<std::uint32_t> ring_start{0}, line_start{0}, corners;
  BodyShape shape{};
  double farthest = 0;  ///< m, from the scene's origin, along an axis
};

/// The sides that a boundary follows, [side] as CoverSink::add_boundary_vertex() numbers them.
std::vector<std::pair<Vec2, Vec2>> sides_of(const GivenShape& given) {
  std::vector<std::pair<Vec2, Vec2>> sides;
  const auto append = [&](const std::vector<double>& x, const std::vector<double>& y,
                          const std::vector<std::uint32_t>& start, bool closed) {
    for (std::size_t line = 0; line + 1 < start.size(); ++line) {
      for (std::uint32_t i = start[line]; i < start[line + 1]; ++i) {
        const bool last = i + 1 == start[line + 1];
        const std::uint32_t next = !last ? i + 1 : closed ? start[line] : i;
        sides.push_back({{x[i], y[i]}, {x[next], y[next]}});
      }
    }
  };
  append(given.x, given.y, given.ring_start, true);
  append(given.line_x, given.line_y, given.line_start, false);
  return sides;
}

/// Contact sees nothing of a body but its boundary: it has to be where the body is, all of it, and the right
/// way round.
std::string fault_of_boundary(const LaidCover& cover, const GivenShape& given) {
  if (cover.loops.empty())
    return fmt::format("it has {} elements and {} patches, which takes a boundary, and gave none",
                       cover.elements.size(), cover.patches.size());
  const std::vector<std::pair<Vec2, Vec2>> sides = sides_of(given);
  const auto [left, right] = std::minmax_element(given.x.begin(), given.x.end());
  const auto [low, high] = std::minmax_element(given.y.begin(), given.y.end());
  const double near = 1e-6 * std::max(*right - *left, *high - *low);
  double area = 0;
  for (const auto& loop : cover.loops) {
    if (loop.size() < 3) return fmt::format("a loop of its boundary has {} vertices", loop.size());
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const LaidCover::BoundaryVertex &vertex = loop[i], &next = loop[i + 1 == loop.size() ? 0 : i + 1];
      if (vertex.element >= cover.elements.size() || vertex.side >= sides.size())
        return fmt::format("a boundary vertex names element {} of {} and side {} of {}", vertex.element,
                           cover.elements.size(), vertex.side, sides.size());
      area += (vertex.at.x * next.at.y - vertex.at.y * next.at.x) / 2;
      const auto [from, to] = sides[vertex.side];
      const double off = std::max(distance_from(vertex.at, from, to), distance_from(next.at, from, to));
      if (!(off <= near))
        return fmt::format(
            "its boundary at ({:.6g}, {:.6g}) m from the centroid is {:.3g} m off side {}, "
            "which it is to follow",
            vertex.at.x, vertex.at.y, off, vertex.side);
    }
  }
  if (!(std::abs(area - given.shape.moments.area) <= 1e-6 * given.shape.moments.area)) {
    return fmt::format("its boundary surrounds {:.12g} m2, the body has {:.12g} m2", area,
                       given.shape.moments.area);
  }
  return "";
}

double boundary_length(const GivenShape& given) {
  double sum = 0;
  for (std::size_t ring = 0; ring + 1 < given.ring_start.size(); ++ring) {
    const std::uint32_t begin = given.ring_start[ring], end = given.ring_start[ring + 1];
    for (std::uint32_t i = begin; i < end; ++i) {
      const std::uint32_t next = i + 1 == end ? begin : i + 1;
      sum += std::hypot(given.x[next] - given.x[i], given.y[next] - given.y[i]);
    }
  }
  return sum;
}

/// What makes it no cover of the body, in words; "" if nothing.
std::string fault_of(const LaidCover& cover, const GivenShape& given) {
  if (cover.rigid) {
    if (cover.patches.empty() && cover.elements.empty()) return "";
    return fmt::format("it made {} patches and {} elements of a rigid body, which has none",
                       cover.patches.size(), cover.elements.size());
  }
  if (cover.elements.empty()) return "it made no element";
  double area = 0;
  for (const LaidCover::LaidElement& element : cover.elements) {
    for (const std::uint32_t patch : element.patches) {
      if (patch >= cover.patches.size())
        return fmt::format("an element names patch {} of {}", patch, cover.patches.size());
    }
    area += element.moments.area;
  }
  // A needle is thinner than what rounding makes of its places about the centroid.
  const double rounded = 0x1p-50 * given.farthest * boundary_length(given);
  if (!(std::abs(area - given.shape.moments.area) <= 1e-9 * given.shape.moments.area + rounded)) {
    return fmt::format("its elements have an area of {:.12g} m2, the body has {:.12g} m2", area,
                       given.shape.moments.area);
  }
  const bool block = cover.elements.size() == 1 && cover.patches.size() == 3;
  if (!(cover.strain_mass_scale >= 1 && std::isfinite(cover.strain_mass_scale)) ||
      (cover.strain_mass_scale != 1 && !block)) {
    return fmt::format(
        "it scales the mass of strain by {}, which takes a factor of 1 or more and one element of three "
        "patches",
        cover.strain_mass_scale);
  }
  if (block) return "";
  if (std::string fault = fault_of_boundary(cover, given); !fault.empty()) return fault;
  std::vector<char> is_steadied(cover.patches.size(), 0);
  for (const LaidCover::Steadied& one : cover.steadied) {
    const auto known = [&](std::uint32_t patch) { return patch < cover.patches.size(); };
    if (!known(one.patch) || !std::all_of(one.to.begin(), one.to.end(), known))
      return "it steadies a patch that does not exist";
    const double sum = one.weights[0] + one.weights[1] + one.weights[2];
    if (!(std::abs(sum - 1) <= 1e-9))
      return fmt::format("patch {} is to follow others with weights of {:.12g} in all, not 1", one.patch,
                         sum);
    if (!(one.inertia_area > 0))
      return fmt::format("patch {} is to get the inertia of {:.6g} m2, which takes more than 0", one.patch,
                         one.inertia_area);
    is_steadied[one.patch] = 1;
  }
  for (const LaidCover::Steadied& one : cover.steadied) {
    for (const std::uint32_t patch : one.to) {
      if (is_steadied[patch] != 0)
        return fmt::format("patch {} is to follow patch {}, which is steadied itself", one.patch, patch);
    }
  }
  return "";
}

}  // namespace

LaidCover lay_cover(const SceneBody& scene_body, const Body& body) {
  const GivenShape given(scene_body, body);
  const auto builder = make<CoverBuilder>(*scene_body.cover.component, scene_body.cover.values);
  Sink sink;
  builder->build(given.shape, sink);
  const char* name = scene_body.cover.component->component->name;
  if (!sink.refusal.empty())
    throw BodyRefused(
        fmt::format("body '{}' cannot have the cover '{}': {}", scene_body.name, name, sink.refusal));
  if (const std::string fault = fault_of(sink.cover, given); !fault.empty()) {
    throw PluginError(fmt::format("{}: cover '{}' does not fit body '{}': {}",
                                  scene_body.cover.component->file.string(), name, scene_body.name, fault));
  }
  return std::move(sink.cover);
}

}  // namespace talus
