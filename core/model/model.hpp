#pragma once

#include "geometry/convex_pieces.hpp"
#include "geometry/polygon.hpp"
#include "scene/scene.hpp"

#include <cstdint>
#include <vector>

namespace talus {

enum class Kinematics { fixed, rigid, affine };

struct Matrix2 {
  double xx = 0, xy = 0, yx = 0, yy = 0;
};

/// What stays of a body while it moves. Positions X are relative to the centroid at the start.
struct Body {
  Kinematics kinematics = Kinematics::fixed;
  Vec2 centre;             ///< m, centroid at the start, without the scene's origin
  double mass = 0;         ///< kg per metre of thickness
  AreaMoments moments{};   ///< about the centroid
  double inertia = 0;      ///< kg m, about the centroid (rigid)
  Matrix2 inverse_moment;  ///< (ρJ)⁻¹, 1/(kg m): the deformation part of the consistent mass (Eq. 17)
  double width = 0;        ///< m, smallest
  std::uint32_t corner_begin = 0, corner_end = 0;
  std::uint32_t piece_begin = 0, piece_end = 0;
  std::vector<Vec2> patches;  ///< star points, relative to the centroid
};

/// The bodies of a scene as arrays.
///
/// The three patch displacements of an affine block are written as d_i = u + H X_i: u the displacement of the
/// centroid, H the displacement gradient. In that basis the consistent mass of Eq. 17 falls apart into m for
/// u and ρJ for each row of H, J the second moments of the polygon, and the block is updated in closed form.
/// A rigid body is the same with H = R − I.
struct Model {
  std::vector<Body> bodies;

  // Corners of the convex pieces of all bodies.
  std::vector<double> reference_x, reference_y;  ///< [corner] m, X
  std::vector<std::uint32_t> surface, cut;       ///< [corner] see talus::Boundaries
  std::vector<std::uint32_t> corner_body;        ///< [corner]
  std::vector<std::uint32_t> piece_start;        ///< [piece + 1]
  std::vector<std::uint32_t> piece_body;         ///< [piece]

  // Elements of the affine blocks, sorted by material.
  std::vector<std::uint32_t> element_body;            ///< [element]
  std::vector<std::uint32_t> material_element_start;  ///< [material + 1]

  double smallest_width = 0;  ///< m, of the moving bodies
  double mean_width = 0;

  bool moves(std::uint32_t body) const { return bodies[body].kinematics != Kinematics::fixed; }
};

/// Throws PluginError when a cover builder makes what the program cannot carry.
Model build_model(const Scene& scene);

}  // namespace talus
