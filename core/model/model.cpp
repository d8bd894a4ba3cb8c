#include "model/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace talus {
namespace {

/// Takes what a cover builder makes of one body.
class BodySink final : public CoverSink {
 public:
  std::uint32_t add_patch(double x, double y) noexcept override {
    patches.push_back({x, y});
    return static_cast<std::uint32_t>(patches.size() - 1);
  }

  std::uint32_t add_element(const std::uint32_t /*patches*/[3], const AreaMoments& region) noexcept override {
    moments = region;
    return elements++;
  }

  void make_rigid() noexcept override { rigid = true; }

  std::vector<Vec2> patches;
  AreaMoments moments{};
  std::uint32_t elements = 0;
  bool rigid = false;
};

AreaMoments moments_about(const SceneBody& body, Vec2 centre) {
  AreaMoments sum = ring_moments(body.outer.vertices, centre);
  for (const Loop& hole : body.holes) sum = sum + ring_moments(hole.vertices, centre);
  return sum;
}

BodySink lay_cover(const SceneBody& scene_body, const Body& body) {
  std::vector<double> x, y;
  std::vector<std::uint32_t> loop_start{0};
  const auto append = [&](const Loop& loop) {
    for (const Vec2& vertex : loop.vertices) {
      x.push_back(vertex.x - body.centre.x);
      y.push_back(vertex.y - body.centre.y);
    }
    loop_start.push_back(static_cast<std::uint32_t>(x.size()));
  };
  append(scene_body.outer);
  for (const Loop& hole : scene_body.holes) append(hole);

  const auto builder = make<CoverBuilder>(*scene_body.cover.component, scene_body.cover.values);
  BodySink sink;
  builder->build({x.data(), y.data(), loop_start.data(), static_cast<std::uint32_t>(loop_start.size() - 1)},
                 body.moments, sink);
  if (!sink.rigid && (sink.elements != 1 || sink.patches.size() != 3)) {
    throw PluginError(
        fmt::format("{}: cover '{}' made {} patches and {} elements of body '{}'; this version carries one "
                    "element of three "
                    "patches, or a rigid body",
                    scene_body.cover.component->file.string(), scene_body.cover.component->component->name,
                    sink.patches.size(), sink.elements, scene_body.name));
  }
  return sink;
}

void set_mass(Body& body, double density) {
  const AreaMoments& m = body.moments;
  body.mass = density * m.area;
  body.inertia = density * (m.xx + m.yy);
  const double determinant = density * (m.xx * m.yy - m.xy * m.xy);
  body.inverse_moment = {m.yy / determinant, -m.xy / determinant, -m.xy / determinant, m.xx / determinant};
}

void add_pieces(Model& model, const SceneBody& scene_body, Body& body, std::uint32_t index) {
  body.piece_begin = static_cast<std::uint32_t>(model.piece_body.size());
  body.corner_begin = static_cast<std::uint32_t>(model.surface.size());
  for (const ConvexPiece& piece : convex_pieces(scene_body.outer, scene_body.holes)) {
    for (const PieceCorner& corner : piece) {
      model.reference_x.push_back(corner.at.x - body.centre.x);
      model.reference_y.push_back(corner.at.y - body.centre.y);
      model.surface.push_back(corner.surface);
      model.cut.push_back(corner.cut);
      model.corner_body.push_back(index);
    }
    model.piece_body.push_back(index);
    model.piece_start.push_back(static_cast<std::uint32_t>(model.surface.size()));
  }
  body.piece_end = static_cast<std::uint32_t>(model.piece_body.size());
  body.corner_end = static_cast<std::uint32_t>(model.surface.size());
}

void sort_elements(Model& model, const Scene& scene) {
  model.material_element_start.push_back(0);
  for (std::uint32_t material = 0; material < scene.materials.size(); ++material) {
    for (std::uint32_t i = 0; i < model.bodies.size(); ++i) {
      const bool here = scene.bodies[i].material == material;
      if (here && model.bodies[i].kinematics == Kinematics::affine) model.element_body.push_back(i);
    }
    model.material_element_start.push_back(static_cast<std::uint32_t>(model.element_body.size()));
  }
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

Model build_model(const Scene& scene) {
  Model model;
  model.piece_start.push_back(0);
  for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
    const SceneBody& scene_body = scene.bodies[i];
    Body body;
    const Vec2 first = scene_body.outer.vertices.front();
    const AreaMoments about_first = moments_about(scene_body, first);
    body.centre = {first.x + about_first.x / about_first.area, first.y + about_first.y / about_first.area};
    body.moments = about_centroid(moments_about(scene_body, body.centre));
    body.width = smallest_width(scene_body.outer.vertices);
    if (!scene_body.fixed) {
      BodySink cover = lay_cover(scene_body, body);
      body.kinematics = cover.rigid ? Kinematics::rigid : Kinematics::affine;
      if (!cover.rigid) body.moments = cover.moments;
      body.patches = std::move(cover.patches);
      set_mass(body, scene.materials[scene_body.material].density);
    }
    add_pieces(model, scene_body, body, i);
    model.bodies.push_back(std::move(body));
  }
  sort_elements(model, scene);
  measure_widths(model);
  return model;
}

}  // namespace talus
