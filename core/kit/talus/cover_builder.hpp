#pragma once

#include <cstdint>

namespace talus {

/// A region as rings of vertices, relative to the reference centre (centroid) of its body, m: counter-
/// clockwise rings count as area, clockwise ones as holes in it. Side i of all rings together runs from
/// vertex i to the next vertex of its ring.
struct Region {
  const double* x;  ///< [vertex]
  const double* y;
  const std::uint32_t* ring_start;  ///< [ring_count + 1]
  std::uint32_t ring_count;
};

/// Open polylines along which a body is cut. They may meet, cross, leave the body or end within it.
struct Discontinuities {
  const double* x;  ///< [point]
  const double* y;
  const std::uint32_t* line_start;  ///< [line_count + 1]
  std::uint32_t line_count;
};

/// Triangles fitted to the body, where its shape came from a mesh.
struct Triangulation {
  const double* x;  ///< [node]
  const double* y;
  const std::uint32_t (*corners)[3];  ///< [triangle] counter-clockwise
  std::uint32_t node_count;
  std::uint32_t triangle_count;
};

/// Integrals of a region about the reference centre: ∫dA, ∫x, ∫y, ∫xx, ∫xy, ∫yy.
struct AreaMoments {
  double area, x, y, xx, xy, yy;
};

/// A body to be covered.
struct BodyShape {
  Region outline;  ///< ring 0 is the outer boundary, the others are holes
  AreaMoments moments;
  Discontinuities discontinuities;
  Triangulation mesh;  ///< no triangles where the body came as a polygon
};

/// Receives what a builder makes. Numbers are per body, from 0, in the order of the calls.
class CoverSink {
 public:
  /// A physical patch (Eq. 8) with the star point at (x, y); 0th-order unknowns (Eq. 9). Returns its number.
  virtual std::uint32_t add_patch(double x, double y) noexcept = 0;

  /// A manifold element shared by three patches; the weights are those of the triangle of the star points,
  /// continued beyond it where the region is larger. Returns its number.
  virtual std::uint32_t add_element(const std::uint32_t patches[3], const Region& region) noexcept = 0;

  /// The boundary, loop after loop with the body on its left; needed where a body has several elements. A
  /// vertex stands wherever the boundary turns or passes from one element to the next. `element` carries the
  /// vertex; `side` is what the boundary follows from here on: a side of the outline by the number of its
  /// first vertex, or vertex_count of the outline + the number of the first point of a side of a
  /// discontinuity.
  virtual void add_boundary_vertex(double x, double y, std::uint32_t element,
                                   std::uint32_t side) noexcept = 0;
  virtual void close_boundary_loop() noexcept = 0;

  /// A patch with so little of the body that it would dictate the time step follows the affine continuation
  /// of three others, d = Σ weights·d_to: exactly, if `inertia_area` is infinite; otherwise its deviation
  /// gets the inertia of `inertia_area` m² of the body on top, which leaves translation, rotation and uniform
  /// strain as heavy as they are. The three must not be steadied themselves.
  virtual void steady_patch(std::uint32_t patch, const std::uint32_t to[3], const double weights[3],
                            double inertia_area) noexcept = 0;

  /// Of one element of three patches: what its strain modes move is `scale` times as heavy, at least 1.
  /// Motion of the body as a rigid one keeps its mass and inertia (selective mass scaling).
  virtual void scale_strain_mass(double scale) noexcept = 0;

  /// The body moves as a rigid one: three unknowns, no patch, no element.
  virtual void make_rigid() noexcept = 0;

  /// The body cannot be covered; `why` goes to the user, together with the names of body and cover.
  virtual void refuse(const char* why) noexcept = 0;

 protected:
  ~CoverSink() = default;
};

/// Lays a mathematical cover over a body and cuts it into physical patches and manifold elements (§2.2).
class CoverBuilder {
 public:
  virtual ~CoverBuilder() = default;

  virtual void build(const BodyShape& body, CoverSink& sink) const noexcept = 0;
};

}  // namespace talus
