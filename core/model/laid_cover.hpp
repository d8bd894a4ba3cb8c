#pragma once

#include "geometry/polygon.hpp"
#include "model/model.hpp"
#include "scene/scene.hpp"

#include <talus/cover_builder.hpp>

#include <array>
#include <string>
#include <vector>

namespace talus {

/// What a cover builder made of one body. Positions relative to the body's centroid, m.
struct LaidCover {
  struct LaidElement {
    std::array<std::uint32_t, 3> patches;
    std::vector<Ring> region;
    AreaMoments moments;  ///< of the region, about the body's centroid
  };
  struct BoundaryVertex {
    Vec2 at;
    std::uint32_t element, side;  ///< as in CoverSink::add_boundary_vertex
  };
  struct Steadied {
    std::uint32_t patch;
    std::array<std::uint32_t, 3> to;
    std::array<double, 3> weights;
    double inertia_area;
  };

  bool rigid = false;
  std::vector<Vec2> patches;
  std::vector<LaidElement> elements;
  std::vector<std::vector<BoundaryVertex>> loops;
  std::vector<Steadied> steadied;
};

/// Calls the cover builder of a body. Throws PluginError when it refuses or makes what is no cover of it.
LaidCover lay_cover(const SceneBody& scene_body, const Body& body);

}  // namespace talus
