#pragma once

#include "geometry/polygon.hpp"
#include "model/partition.hpp"
#include "scene/scene.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace talus {

/// How a body moves: not at all, by (u, θ), by (u, H) of one element, or by the displacements of its patches.
enum class Kinematics : std::uint8_t { fixed, rigid, affine, covered };

struct Matrix2 {
  double xx = 0, xy = 0, yx = 0, yy = 0;
};

inline constexpr std::uint32_t no_patch = 0xFFFFFFFFu;

/// Three patches and their weights at a point (Eq. 11); no_patch where the motion of the body as a whole says
/// it all.
struct Carrier {
  std::array<std::uint32_t, 3> patch{no_patch, no_patch, no_patch};
  std::array<double, 3> weight{};
};

/// A point of a body and what carries it.
struct MaterialPoint {
  std::uint32_t body = 0;
  Vec2 reference;  ///< m, X relative to the centroid at the start
  Carrier carrier;
};

/// A side of a body's boundary between two corners; displacement is affine along it.
struct BoundarySide {
  MaterialPoint start, end;
  std::uint32_t surface;     ///< index into Scene::surfaces
  bool is_cut_face = false;  ///< of a discontinuity; else it is of the body's outline
};

/// Three patches and the gradients of their weights; of an affine block, which is its own element, no_patch.
struct Element {
  std::array<std::uint32_t, 3> patch{no_patch, no_patch, no_patch};
  std::array<Vec2, 3> gradient{};  ///< 1/m
};

/// A patch that follows the affine continuation of three others (CoverSink::steady_patch).
struct SteadyPatch {
  std::uint32_t patch;
  Carrier to;
  double inertia;  ///< kg per metre of thickness against the deviation; infinite: none is allowed
};

/// A piece of a body of many elements: what lies behind one side of its boundary.
struct Strip {
  std::uint32_t side;                              ///< index into Model::sides
  double depth;                                    ///< m
  std::uint32_t competitor_begin, competitor_end;  ///< entries of Model::competitors
  std::uint32_t fragment;                          ///< alike for all of one that joints cut out of the body
};

/// A patch at the boundary of a body and what its displacement adds to the mean displacement gradient,
/// 1/m: Σ area ∇w of its elements over the area of the body. Of a patch whose elements close around it that
/// is zero.
struct OuterPatch {
  std::uint32_t patch;
  Vec2 mean_gradient;
};

/// Where in the Model's arrays a body of many elements has what it consists of; of others all is empty.
struct CoverRanges {
  std::uint32_t side_begin = 0, side_end = 0;      ///< sides of its boundary
  std::uint32_t patch_begin = 0, patch_end = 0;    ///< its patches
  std::uint32_t steady_begin = 0, steady_end = 0;  ///< its steadied patches
  std::uint32_t outer_begin = 0, outer_end = 0;    ///< its outer patches

  // How it is divided (see Partition).
  std::uint32_t own_end = 0;       ///< patches from patch_begin on that are own
  std::uint32_t free_end = 0;      ///< common patches before it have no part in `steady`
  std::uint32_t common_index = 0;  ///< of patch own_end in Partition::common_start
  std::uint32_t subdomain_begin = 0, subdomain_end = 0;  ///< its subdomains
  std::uint32_t lattice = 0;                             ///< entry of Partition::lattices

  double contact_depth = std::numeric_limits<double>::infinity();  ///< m, how deep contact can be seen
};

/// What stays of a body while it moves. Positions X are relative to the centroid at the start.
struct Body {
  Kinematics kinematics = Kinematics::fixed;
  bool meets_itself = false;   ///< whether parts of its boundary may touch each other
  bool outline_meets = false;  ///< whether both of them may be of the outline of one fragment
  std::uint32_t ranges = 0;    ///< entry of Model::cover_ranges
  Vec2 centre;                 ///< m, centroid at the start, without the scene's origin
  double mass = 0;             ///< kg per metre of thickness
  CentralMoments moments{};
  double strain_mass_scale = 1;  ///< see StrainMass (affine)
  double width = 0;         ///< m, smallest; of many elements: the smaller of that and their typical size
  double contact_mass = 0;  ///< kg per metre: that of the body, or of a patch of the boundary
  std::uint32_t corner_begin = 0, corner_end = 0;
  std::uint32_t piece_begin = 0, piece_end = 0;
  std::uint32_t element_begin = 0, element_end = 0;  ///< entries of Model::body_element

  double density() const { return mass / moments.area; }  ///< kg/m³
  /// kg m, about the centroid (rigid).
  double inertia() const { return density() * (moments.xx + moments.yy); }
  /// (ρJ)⁻¹, 1/(kg m): the deformation part of the consistent mass (Eq. 17).
  Matrix2 inverse_moment() const;
};

/// The bodies of a scene as arrays.
///
/// The three patch displacements of an affine block are written as d_i = u + H X_i: u the displacement of the
/// centroid, H the displacement gradient. In that basis the consistent mass of Eq. 17 falls apart into m for
/// u and ρJ for each row of H, J the second moments of the polygon, and the block is updated in closed form.
/// A rigid body is the same with H = R − I. A body of many elements keeps its patches, with the row sums of
/// Eq. 17 as masses.
struct Model {
  std::vector<Body> bodies;
  std::vector<CoverRanges> cover_ranges{1};  ///< the first: of all bodies that move as a whole or not at all
  // Those that a step has to do with: fixed bodies take no part in its loops.
  std::vector<std::uint32_t> moving_bodies;
  std::vector<std::uint32_t> covered_bodies;  ///< of many elements

  // Corners of the pieces of all bodies (see talus::Boundaries).
  std::vector<double> reference_x, reference_y;  ///< [corner] m, X
  std::vector<std::uint32_t> surface, cut;       ///< [corner]
  std::vector<std::uint32_t> piece_start;        ///< [piece + 1]
  std::vector<std::uint32_t> piece_body;         ///< [piece]
  std::vector<std::uint8_t> is_strip;            ///< [piece]
  std::vector<std::uint32_t> piece_strip;        ///< [piece] of a strip: its entry in `strips`; or empty
  std::vector<Strip> strips;
  std::vector<std::uint32_t> competitors;  ///< sides that a strip shares its ground with

  std::vector<BoundarySide> sides;  ///< of the covered bodies, body after body, loop after loop
  std::vector<std::uint32_t> next_side, previous_side;  ///< [side] around its loop
  std::vector<double>
      side_size;  ///< [side] m, side of an equilateral triangle as large as the element's patches

  // Bodies of many elements.
  std::vector<Vec2> patch_star;    ///< [patch] m, X of the star point
  std::vector<double> patch_mass;  ///< [patch] kg per metre of thickness, row sum of Eq. 17
  std::vector<double> row_sum;     ///< [patch] the same before anything was done about slivers
  std::vector<SteadyPatch> steady;
  std::vector<OuterPatch> outer_patches;
  Partition partition;

  // Elements of the bodies that deform, sorted by material.
  std::vector<std::uint32_t> element_body;            ///< [element]
  std::vector<double> element_area;                   ///< [element] m²
  std::vector<std::uint32_t> material_element_start;  ///< [material + 1]
  std::vector<std::uint32_t> body_element;            ///< elements body after body, as the cover made them
  // All empty where no body is covered.
  std::vector<Element> elements;
  std::vector<std::array<double, 4>> element_box;  ///< [element] m, least x and y, greatest x and y
  std::vector<std::vector<Ring>> element_region;   ///< [element] rings, m, X; empty for an affine block

  double smallest_width = 0;  ///< m, of the moving bodies
  double mean_width = 0;

  bool moves(std::uint32_t body) const { return bodies[body].kinematics != Kinematics::fixed; }
  /// With one velocity and one rotation, and no other motion but uniform strain.
  bool moves_as_a_whole(std::uint32_t body) const { return moves(body) && !covered(body); }
  bool covered(std::uint32_t body) const { return bodies[body].kinematics == Kinematics::covered; }
  /// Whether most moving bodies have many elements: then few bodies are much work.
  bool mostly_covered() const { return 2 * covered_bodies.size() > moving_bodies.size(); }
  CoverRanges& ranges(const Body& body) { return cover_ranges[body.ranges]; }
  const CoverRanges& ranges(const Body& body) const { return cover_ranges[body.ranges]; }
  /// Whether the body is convex itself.
  bool one_piece(const Body& body) const {
    return body.piece_end == body.piece_begin + 1 && is_strip[body.piece_begin] == 0;
  }

  /// Calls visit(corner) for those that say where the boundary of a body is and how fast: of a strip the
  /// first alone, for the second is the first of the next one, and the others are led by both.
  template <class Visit>
  void visit_boundary(const Body& body, const Visit& visit) const {
    for (std::uint32_t piece = body.piece_begin; piece < body.piece_end; ++piece) {
      const std::uint32_t begin = piece_start[piece],
                          end = is_strip[piece] != 0 ? begin + 1 : piece_start[piece + 1];
      for (std::uint32_t c = begin; c < end; ++c) visit(c);
    }
  }

  /// The corner where a side of a body of many elements starts, that of its strip.
  std::uint32_t side_corner(const Body& body, std::uint32_t side) const {
    return piece_start[body.piece_begin + side - ranges(body).side_begin];
  }

  /// The first of a body's elements, where those of a covered body lie side by side.
  std::uint32_t first_element(const Body& body) const { return body_element[body.element_begin]; }

  /// A point of a body by its reference position; of a body of many elements, in the element it lies in or,
  /// outside all, nearest to.
  MaterialPoint point(std::uint32_t body, Vec2 reference) const;
  std::uint32_t element_at(std::uint32_t body, Vec2 reference) const;
  Carrier carrier(const Element& element, Vec2 reference) const;
};

/// The sides of a moving body's boundary, loop after loop.
std::vector<BoundarySide> boundary_of(const Scene& scene, const Model& model, std::uint32_t body);

/// Throws SceneError when bodies cannot have their cover or be cut, PluginError when a builder makes what is
/// no cover. `given`: [body] its number in the file of the scene, where that is another.
Model build_model(const Scene& scene, std::span<const std::uint32_t> given = {});

}  // namespace talus
