#pragma once

#include <cstdint>

namespace talus {

/// A body to be covered, relative to its reference centre (centroid), m. Loop 0 is the outer boundary,
/// counter-clockwise; the others are holes, clockwise.
struct Outline {
  const double* x;  ///< [vertex]
  const double* y;
  const std::uint32_t* loop_start;  ///< [loop_count + 1]
  std::uint32_t loop_count;
};

/// Integrals of a region about the reference centre: ∫dA, ∫x, ∫y, ∫xx, ∫xy, ∫yy.
struct AreaMoments {
  double area, x, y, xx, xy, yy;
};

/// Receives what a builder makes. Numbers are per body, from 0, in the order of the calls.
class CoverSink {
 public:
  /// A physical patch (Eq. 8) with the star point at (x, y); 0th-order unknowns (Eq. 9). Returns its number.
  virtual std::uint32_t add_patch(double x, double y) noexcept = 0;

  /// A manifold element shared by three patches; weights are those of the triangle of the star points.
  virtual std::uint32_t add_element(const std::uint32_t patches[3], const AreaMoments& region) noexcept = 0;

  /// Whether the body moves as a rigid one: three unknowns, no patch, no element.
  virtual void make_rigid() noexcept = 0;

 protected:
  ~CoverSink() = default;
};

/// Lays a mathematical cover over a body and cuts it into physical patches and manifold elements (§2.2).
class CoverBuilder {
 public:
  virtual ~CoverBuilder() = default;

  /// Integrals of the whole body come along, since every builder needs them.
  virtual void build(const Outline& outline, const AreaMoments& body, CoverSink& sink) const noexcept = 0;

  /// Number of the element that the boundary point (x, y) belongs to.
  virtual std::uint32_t element_at(double x, double y) const noexcept = 0;
};

}  // namespace talus
