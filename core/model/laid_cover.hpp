#pragma once

#include "geometry/polygon.hpp"
#include "model/model.hpp"
#include "scene/scene.hpp"

#include <talus/cover_builder.hpp>

#include <array>
#include <stdexcept>
#include <vector>

namespace talus {

/// What a cover builder made of one body. Positions relative to the body's centroid, m.
struct LaidCover {
  struct LaidElement {
    std::array<std::uint32_t, 3> patches;
    std::vector<Ring> region;
    AreaMoments moments;  ///< of the region, about the body's centroid
    int lattice = 0;      ///< +1, −1: a whole lower or upper triangle of a regular lattice
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
  double strain_mass_scale = 1;
  std::vector<Vec2> patches;
  std::vector<LaidElement> elements;
  std::vector<std::vector<BoundaryVertex>> loops;
  std::vector<Steadied> steadied;
};

/// A body of the scene that cannot have what the scene asks for, in words for the user.
class BodyRefused : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Calls the cover builder of a body. Throws BodyRefused when it refuses, PluginError when it makes what is
/// no cover of it.
LaidCover lay_cover(const SceneBody& scene_body, const Body& body);

}  // namespace talus
